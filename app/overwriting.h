// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <span>

namespace loft::app {

/// Whether two paths name one file, which need not be there yet.
[[nodiscard]] bool is_same_file(const std::filesystem::path& a, const std::filesystem::path& b);

/// Throws UsageError if an output is one of the inputs, by whatever path.
void forbid_overwriting(std::span<const std::filesystem::path> inputs,
                        std::span<const std::filesystem::path> outputs);

}  // namespace loft::app
