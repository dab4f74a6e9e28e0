// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

#include "cdt/point.h"

namespace loft::paths {

using cdt::Point;

/// A vector; of length 1 where it is a direction.
struct Direction {
  double x = 0;
  double y = 0;
};

[[nodiscard]] inline double cross(Direction a, Direction b) { return a.x * b.y - a.y * b.x; }
[[nodiscard]] inline double dot(Direction a, Direction b) { return a.x * b.x + a.y * b.y; }
[[nodiscard]] inline double length_of(Direction a) { return std::sqrt(a.x * a.x + a.y * a.y); }

/// What a taut path bends around: a circle that it keeps on its left, radius > 0, or on its right,
/// radius < 0; or a point, 0.
struct Circle {
  Point centre;
  double radius = 0;
};

/// A straight way that touches two circles, as they lie, one after the other.
struct Tangent {
  Direction along;
  double length = 0;

  /// Where it touches a circle.
  [[nodiscard]] Point touch(const Circle& circle) const {
    return {circle.centre.x + circle.radius * along.y, circle.centre.y - circle.radius * along.x};
  }
};

/// The tangent from one circle to another. Where they overlap, as rounding may have it, it has no
/// length.
[[nodiscard]] inline Tangent tangent(const Circle& from, const Circle& to) {
  const Direction way{to.centre.x - from.centre.x, to.centre.y - from.centre.y};
  const double distance = length_of(way);
  if (distance == 0) return {};
  const double sine = std::clamp((to.radius - from.radius) / distance, -1.0, 1.0);
  const double cosine = std::sqrt((1 - sine) * (1 + sine));
  return {{(way.x * cosine + way.y * sine) / distance, (way.y * cosine - way.x * sine) / distance},
          distance * cosine};
}

/// The angle from one direction to another, counter-clockwise positive, below half a turn in
/// magnitude. Of additions, products, quotients and square roots alone, so the same everywhere,
/// unlike std::atan2. Off by some 1e-16 of itself.
[[nodiscard]] double angle_between(Direction from, Direction to);

}  // namespace loft::paths
