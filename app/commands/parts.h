// SPDX-License-Identifier: MIT
#pragma once

#include <set>
#include <string>
#include <vector>

#include "app/commands/commands.h"
#include "io/meshes/part.h"
#include "reconstruct/stack.h"

namespace loft::app {

/// The labels that start hidden. Throws UsageError that names what no label is called.
[[nodiscard]] std::set<std::string> hidden_labels(const ReconstructCommand& command,
                                                  const std::vector<std::string>& labels);

/// A part of a stack, with all that the stack says of its label, but for its surface.
[[nodiscard]] io::Part part_of(const ReconstructCommand& command, const Stack& stack,
                               const std::string& label);

/// Whether an output is glTF.
[[nodiscard]] bool is_gltf(const std::filesystem::path& output);

/// Throws UsageError where options for glTF are given and no output is.
void check_gltf_options(const ReconstructCommand& command);

}  // namespace loft::app
