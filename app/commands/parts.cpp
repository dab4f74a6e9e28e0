// SPDX-License-Identifier: MIT
#include "app/commands/parts.h"

#include <algorithm>

#include "app/commands/label_choice.h"
#include "app/exit_code.h"
#include "io/bytes/file.h"
#include "io/gltf/meshopt.h"
#include "io/stack.h"

namespace loft::app {

namespace {

/// The file that a label comes from, where that is known: the only one, or the one of its name.
std::string source_of(const ReconstructCommand& command, const std::string& label) {
  if (command.inputs.size() == 1) return command.inputs[0].filename().string();
  const std::vector<std::string> names = io::labels_of(command.inputs, command.read.unlabelled);
  const auto found = std::ranges::find(names, label);
  if (label.empty() || found == names.end()) return {};
  return command.inputs[static_cast<std::size_t>(found - names.begin())].filename().string();
}

}  // namespace

std::set<std::string> hidden_labels(const ReconstructCommand& command,
                                    const std::vector<std::string>& labels) {
  if (command.hidden.empty()) return {};
  const std::vector<std::string> hidden = LabelChoice(command.hidden, {}).chosen(labels);
  return {hidden.begin(), hidden.end()};
}

io::Part part_of(const ReconstructCommand& command, const Stack& stack, const std::string& label) {
  io::Part part = io::part_of(stack.labels, label);
  part.source = source_of(command, label);
  if (command.with_contours) part.contours = io::contour_lines(stack, label);
  return part;
}

bool is_gltf(const std::filesystem::path& output) {
  const std::string extension = io::extension(output);
  return extension == ".glb" || extension == ".gltf";
}

void check_gltf_options(const ReconstructCommand& command) {
  if (command.compression == io::Compression::meshopt && !io::has_meshopt())
    throw UsageError("--compress meshopt: " + std::string(io::no_meshopt) + ", or choose quantize");
  if (std::ranges::any_of(command.outputs, is_gltf)) return;
  const auto reject = [](const std::string& option) {
    throw UsageError(option + " is for glTF; write .glb or .gltf, or leave it out");
  };
  if (command.compression != io::Compression::none) reject("--compress");
  if (command.with_contours) reject("--with-contours");
  if (!command.hidden.empty()) reject("--hide");
}

}  // namespace loft::app
