// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string_view>

namespace loft::io {

/// Whether a file comes before another in natural order: runs of digits in their names count as
/// numbers, so that `slice_2.png` is before `slice_10.png`.
[[nodiscard]] bool in_natural_order(const std::filesystem::path& a, const std::filesystem::path& b);

}  // namespace loft::io
