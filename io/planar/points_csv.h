// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>
#include <vector>

#include "cdt/point.h"

namespace loft::io {

/// Reads a table of points, one a line, parted by commas, semicolons, tabs or blanks. A header may
/// name the columns x and y, or lon and lat; else these are the first two. Blank lines and lines
/// that begin with `#` are left out.
///
/// Throws InputError that names `name` and line of each bad place, or says that there is no point.
/// Cost: O(n).
[[nodiscard]] std::vector<cdt::Point> read_points_csv(std::string_view text, std::string_view name);

}  // namespace loft::io
