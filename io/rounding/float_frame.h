// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "io/meshes/grid.h"
#include "mesh/box3.h"
#include "mesh/mesh.h"

namespace loft::io {

/// The nearest number that a `float` holds. Not inlined: GCC 12 at -O3 makes vectors of such
/// conversions, and leaves some out (tests/io/rounding).
[[gnu::noinline]] inline double as_float(double number) {
  return static_cast<double>(static_cast<float>(number));
}

/// Where and how long a format with `float` coordinates has things: about an origin, in a unit of
/// its own; or whole numbers, of a grid.
struct FloatFrame {
  Vec3 origin{};      ///< in the input's axes and unit
  double factor = 1;  ///< what a unit of the input is in the file
  /// Of compressed glTF: about the origin, in the file's unit and axes, y up.
  std::optional<Grid> grid = {};

  /// A place as the file has it: rounded. -0 is 0.
  [[nodiscard]] Vec3 rounded(const Vec3& place) const {
    Vec3 result{};
    if (grid) return in_steps(place);
    for (std::size_t axis = 0; axis < 3; ++axis)
      result[axis] = as_float((place[axis] - origin[axis]) * factor) + 0.0;
    return result;
  }

 private:
  [[nodiscard]] Vec3 in_steps(const Vec3& place) const {
    Vec3 moved{};
    for (std::size_t axis = 0; axis < 3; ++axis)
      moved[axis] = (place[axis] - origin[axis]) * factor;
    const Grid::Cell cell = grid->cell({moved[0], moved[2], -moved[1]});
    return {static_cast<double>(cell[0]), -static_cast<double>(cell[2]) + 0.0,
            static_cast<double>(cell[1])};
  }
};

/// 0 for a box around nothing.
[[nodiscard]] inline double longest_side(const Box3& box) {
  double longest = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
    longest = std::max(longest, box.high[axis] - box.low[axis]);
  return longest;
}

/// Whether the last place of the largest coordinates in a box, as `float`, is more than a share of
/// the box's longest side: then shapes are not kept.
[[nodiscard]] inline bool is_coarse(const Box3& box, double share) {
  constexpr double last_place = 0x1p-23;
  double distance = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
    distance = std::max({distance, std::abs(box.low[axis]), std::abs(box.high[axis])});
  return distance * last_place > longest_side(box) * share;
}

}  // namespace loft::io
