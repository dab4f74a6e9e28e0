// SPDX-License-Identifier: MIT
#include "io/volumes/outlines.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "io/volumes/layer_labels.h"
#include "io/volumes/mask_outlines.h"
#include "io/volumes/placement.h"
#include "reconstruct/defect.h"

namespace loft::io {

namespace {

void require_sizes(const Volume& volume) {
  if (volume.slices == 0 || volume.layers == 0 ||
      !MaskOutlines::size_fits(volume.columns, volume.rows))
    throw InputError(volume.name + ": slices of " + std::to_string(volume.columns) + " x " +
                     std::to_string(volume.rows) + " pixels, " + std::to_string(volume.slices) +
                     " of them: there must be some, of 2^28 pixels at most");
}

/// The outlines of a volume, slice by slice.
class Tracing {
 public:
  Tracing(const Volume& volume, const ReadOptions& options)
      : volume_(volume),
        placement_(volume, options),
        labels_(volume),
        outlines_(volume.columns, volume.rows, options.outline),
        pixels_(std::size_t{volume.columns} * volume.rows) {}

  Stack operator()() {
    Stack stack;
    for (std::uint32_t k = 0; k < volume_.slices; ++k) stack.slices.push_back(slice(k));
    stack.unit = volume_.unit;
    stack.frame = placement_.frame();
    stack.fill = Fill::even_odd;
    stack.gap = gap();
    stack.notes = volume_.notes;
    labels_.tell(stack);
    return stack;
  }

 private:
  [[nodiscard]] double position(std::uint32_t k) const {
    return volume_.positions.empty() ? k : volume_.positions[k];
  }

  /// Of uneven slices the smallest.
  [[nodiscard]] double gap() const {
    double least = volume_.positions.size() < 2 ? 1 : HUGE_VAL;
    for (std::size_t k = 1; k < volume_.positions.size(); ++k)
      least = std::min(least, std::abs(volume_.positions[k] - volume_.positions[k - 1]));
    return least * placement_.gap();
  }

  Slice slice(std::uint32_t k) {
    Slice slice{placement_.z(position(k)), {}};
    for (std::uint32_t layer = 0; layer < volume_.layers; ++layer) {
      volume_.read(k, layer, pixels_);
      label_pixels(k, layer);
      std::vector<PixelOutline> outlines = outlines_.trace(pixels_, volume_.level);
      std::ranges::stable_sort(outlines, {}, &PixelOutline::label);
      for (PixelOutline& outline : outlines) {
        for (cdt::Point& point : outline.points) point = placement_.at(point, position(k));
        slice.contours.push_back({std::move(outline.points), labels_.name(outline.label)});
      }
    }
    return slice;
  }

  void label_pixels(std::uint32_t k, std::uint32_t layer) {
    labels_.begin(k, layer);
    for (std::uint32_t y = 0; y < volume_.rows; ++y) {
      const double* value = &pixels_[std::size_t{y} * volume_.columns];
      for (std::uint32_t& label : outlines_.row(y)) label = labels_.of(*value++);
    }
  }

  const Volume& volume_;
  Placement placement_;
  LayerLabels labels_;
  MaskOutlines outlines_;
  std::vector<double> pixels_;
};

}  // namespace

Stack trace(const Volume& volume, const ReadOptions& options) {
  require_sizes(volume);
  Stack stack = Tracing(volume, options)();
  if (std::ranges::all_of(stack.slices, [](const Slice& s) { return s.contours.empty(); }))
    throw InputError(volume.name +
                     ": no pixel is inside of anything; give a file with labels, or with shares "
                     "that reach the level");
  return stack;
}

}  // namespace loft::io
