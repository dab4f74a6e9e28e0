// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <span>

namespace loft::app {

/// Throws UsageError if an output is one of the inputs, by whatever path.
void forbid_overwriting(std::span<const std::filesystem::path> inputs,
                        std::span<const std::filesystem::path> outputs);

}  // namespace loft::app
