// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "mesh/mesh.h"

namespace loft {

/// A closed axis-parallel box in space.
struct Box3 {
  Vec3 low{};
  Vec3 high{};
};

[[nodiscard]] inline bool boxes_meet(const Box3& a, const Box3& b) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (a.high[axis] < b.low[axis] || b.high[axis] < a.low[axis]) return false;
  }
  return true;
}

/// The smallest box around two others.
[[nodiscard]] Box3 joined(const Box3& a, const Box3& b);

/// The axis along which a box is longest; of equals the first.
[[nodiscard]] std::size_t longest_axis(const Box3& box);

/// The smallest box around three points.
[[nodiscard]] Box3 box_around(const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace loft
