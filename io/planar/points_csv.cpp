// SPDX-License-Identifier: MIT
#include "io/planar/points_csv.h"

#include <array>
#include <cstddef>
#include <string>
#include <utility>

#include "io/planar/number_table.h"

namespace loft::io {

namespace {

/// Where x and y are.
std::array<std::size_t, 2> columns_of_points(const NumberTable& table) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 4> known{
      {{"x", "y"}, {"lon", "lat"}, {"lng", "lat"}, {"longitude", "latitude"}}};
  for (const auto& [x, y] : known) {
    const auto first = table.column(x);
    const auto second = table.column(y);
    if (first && second) return {*first, *second};
  }
  return {0, 1};
}

}  // namespace

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
