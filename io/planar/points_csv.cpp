// SPDX-License-Identifier: MIT
#include "io/planar/points_csv.h"

#include <string>

#include "io/planar/columns_of_points.h"
#include "io/planar/number_table.h"

namespace loft::io {

std::vector<cdt::Point> read_points_csv(std::string_view text, std::string_view name) {
  NumberTable table(text, name);
  const auto columns = columns_of_points(table);
  std::vector<cdt::Point> points;
  while (table.next_row()) {
    const auto x = table.coordinate(columns[0], "x");
    const auto y = table.coordinate(columns[1], "y");
    if (x && y) points.push_back({*x, *y});
  }
  table.raise();
  if (points.empty()) throw InputError(std::string(name) + ": no points in it");
  return points;
}

}  // namespace loft::io
