// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <vector>

namespace loft::app {

/// Rows of a table as lines: columns as wide as they must be, the first one to the left, the others
/// to the right. Precondition: the rows have as many cells as the first; texts are UTF-8.
[[nodiscard]] std::vector<std::string> aligned(std::span<const std::vector<std::string>> rows);

}  // namespace loft::app
