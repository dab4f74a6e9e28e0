// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <span>

#include "fields/field.h"

namespace loft::fields {

/// Places in rows, all as far apart.
struct Grid {
  Point first;        ///< the first place of the first row
  double step_x = 1;  ///< to the next place of a row
  double step_y = 1;  ///< to the next row; below 0 from the top downwards
  std::size_t columns = 0;
  std::size_t rows = 0;

  [[nodiscard]] Point place(std::size_t row, std::size_t column) const {
    return {first.x + static_cast<double>(column) * step_x,
            first.y + static_cast<double>(row) * step_y};
  }
};

/// Calls visit(row, values) for each row in turn; not a number where there is no value. On a wall,
/// the value on its left. Law: the same as Field::value(), bit for bit. Cost: each place is found
/// from the one before, so that a row costs the edges that it crosses and its places. Precondition:
/// places are finite.
void rasterize(const Field& field, const Grid& grid, Smoothness smoothness,
               const std::function<void(std::size_t row, std::span<const double> values)>& visit);

}  // namespace loft::fields
