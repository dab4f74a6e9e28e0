// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace loft::app {

/// Whether an output is one file a label: its name has `{label}` in it.
[[nodiscard]] bool is_per_label(const std::filesystem::path& output);

/// The file of each label, in their order: `{label}` replaced, what file systems do not take in
/// names by `_`. Throws UsageError, which names both, where two labels would share one, capitals
/// aside.
[[nodiscard]] std::vector<std::filesystem::path> label_files(const std::filesystem::path& output,
                                                             std::span<const std::string> labels);

}  // namespace loft::app
