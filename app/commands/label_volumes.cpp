// SPDX-License-Identifier: MIT
#include "app/commands/label_volumes.h"

#include "app/commands/commands.h"
#include "app/report.h"
#include "io/unit.h"
#include "mesh/measure.h"
#include "reconstruct/reconstruct.h"

namespace loft::app {

std::map<std::string, LabelVolume> label_volumes(const Stack& stack) {
  const ContoursByLabel contours(stack.slices);
  Options options = ReconstructCommand().options;
  std::map<std::string, LabelVolume> result;
  for (const std::string& label : contours.labels()) {
    LabelVolume& volume = result[label];
    options.label = label;
    try {
      const Reconstructed made = reconstruct(stack, contours, options);
      volume.surface = measure(made.surface).volume;
      volume.slabs = made.slab_volume;
    } catch (const InputError& error) {
      const std::string problem = error.what();
      volume.problem = problem.substr(0, problem.find('\n'));
    }
  }
  return result;
}

std::string describe(const LabelVolume& volume, const std::string& unit) {
  if (!volume.problem.empty()) return "no surface: " + volume.problem;
  const bool is_length = io::metres_per_unit(unit).has_value();
  const auto text = [&](double number) {
    return rounded(is_length ? cubic_centimetres(number, unit) : number);
  };
  return "volume " + text(volume.surface) + (is_length ? " cm^3" : " unit^3") + ", as slabs " +
         text(volume.slabs);
}

double cubic_centimetres(double volume, const std::string& unit) {
  const double centimetres = 100 * io::metres_per_unit(unit).value_or(0.001);
  return volume * centimetres * centimetres * centimetres;
}

}  // namespace loft::app
