// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "cdt/point.h"

namespace loft::io {

/// From where to where a way is asked for.
struct PathQuery {
  cdt::Point from;
  cdt::Point to;
  std::optional<double> radius = {};  ///< of the disc that moves, where it is said: 0 or more

  friend bool operator==(const PathQuery&, const PathQuery&) = default;
};

/// Reads a table of queries, one a line, parted by commas, semicolons, tabs or blanks. A header
/// names the columns x0, y0, x1, y1 and, if there is one, radius; without it these are the first
/// five. An empty radius is not said.
///
/// Throws InputError that names `name` and line of each bad place, columns that the header lacks,
/// or says that there is no query. Cost: O(n).
[[nodiscard]] std::vector<PathQuery> read_path_queries_csv(std::string_view text,
                                                           std::string_view name);

}  // namespace loft::io
