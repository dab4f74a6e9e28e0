// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>

#include "mesh/box3.h"
#include "mesh/predicates.h"

namespace loft {

/// All places within a distance of a triangle, and a few more: between two planes along it, and
/// within three across it at its edges. Tells long thin triangles side by side apart, whose boxes
/// meet. Made of floating point: the distance should be more than rounding may err by.
class Prism {
 public:
  Prism(const Corners& triangle, double distance);

  /// False only if no place of another triangle is in it.
  [[nodiscard]] bool may_meet(const Corners& other) const;

 private:
  /// What is beyond lies farther along a direction than that.
  struct Side {
    Vec3 way{};
    double most = 0;
  };

  Box3 box_;
  double distance_;
  Vec3 start_;  // ways are measured from
  std::array<Side, 5> sides_{};
};

}  // namespace loft
