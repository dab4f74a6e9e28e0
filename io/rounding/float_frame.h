// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "mesh/box3.h"
#include "mesh/mesh.h"

namespace loft::io {

/// Where and how long a format with `float` coordinates has things: about an origin, in a unit of
/// its own.
struct FloatFrame {
  Vec3 origin{};      ///< in the input's axes and unit
  double factor = 1;  ///< what a unit of the input is in the file

  /// A place as the file has it: rounded. -0 is 0.
  [[nodiscard]] Vec3 rounded(const Vec3& place) const {
    Vec3 result{};
    for (std::size_t axis = 0; axis < 3; ++axis)
      result[axis] =
          static_cast<double>(static_cast<float>((place[axis] - origin[axis]) * factor)) + 0.0;
    return result;
  }
};

/// Whether the last place of the largest coordinates in a box, as `float`, is more than a share of
/// the box's longest side: then shapes are not kept.
[[nodiscard]] inline bool is_coarse(const Box3& box, double share) {
  constexpr double last_place = 0x1p-23;
  double size = 0;
  double distance = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    size = std::max(size, box.high[axis] - box.low[axis]);
    distance = std::max({distance, std::abs(box.low[axis]), std::abs(box.high[axis])});
  }
  return distance * last_place > size * share;
}

}  // namespace loft::io
