// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

#include "mesh/mesh.h"

namespace loft {

/// A closed axis-parallel box in space.
struct Box3 {
  Vec3 low{};
  Vec3 high{};
};

/// Around nothing.
inline constexpr Box3 no_box{
    {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
     std::numeric_limits<double>::infinity()},
    {-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
     -std::numeric_limits<double>::infinity()}};

[[nodiscard]] inline bool boxes_meet(const Box3& a, const Box3& b) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (a.high[axis] < b.low[axis] || b.high[axis] < a.low[axis]) return false;
  }
  return true;
}

/// Whether two boxes are no further apart than a distance, along any axis.
[[nodiscard]] inline bool boxes_are_near(const Box3& a, const Box3& b, double distance) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (a.low[axis] - b.high[axis] > distance || b.low[axis] - a.high[axis] > distance)
      return false;
  return true;
}

/// The smallest box around two others.
[[nodiscard]] inline Box3 joined(const Box3& a, const Box3& b) {
  Box3 result;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    result.low[axis] = std::min(a.low[axis], b.low[axis]);
    result.high[axis] = std::max(a.high[axis], b.high[axis]);
  }
  return result;
}

/// The smallest box around another and a point.
[[nodiscard]] inline Box3 extended(const Box3& a, const Vec3& p) { return joined(a, Box3{p, p}); }

/// The smallest box around points.
[[nodiscard]] inline Box3 box_around(const Vec3& a, const Vec3& b) {
  return joined(Box3{a, a}, Box3{b, b});
}
[[nodiscard]] inline Box3 box_around(const Vec3& a, const Vec3& b, const Vec3& c) {
  Box3 result;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    result.low[axis] = std::min(std::min(a[axis], b[axis]), c[axis]);
    result.high[axis] = std::max(std::max(a[axis], b[axis]), c[axis]);
  }
  return result;
}
[[nodiscard]] inline Box3 box_around(const std::array<Vec3, 3>& points) {
  return box_around(points[0], points[1], points[2]);
}

/// The axis along which a box is longest; of equals the first.
[[nodiscard]] std::size_t longest_axis(const Box3& box);

}  // namespace loft
