// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <utility>

#include "io/planar/number_table.h"

namespace loft::io {

/// Where a table has x and y: in the columns of these names, or lon and lat; else in the first two.
[[nodiscard]] inline std::array<std::size_t, 2> columns_of_points(const NumberTable& table) {
  constexpr std::array<std::pair<std::string_view, std::string_view>, 4> known{
      {{"x", "y"}, {"lon", "lat"}, {"lng", "lat"}, {"longitude", "latitude"}}};
  for (const auto& [x, y] : known) {
    const auto first = table.column(x);
    const auto second = table.column(y);
    if (first && second) return {*first, *second};
  }
  return {0, 1};
}

}  // namespace loft::io
