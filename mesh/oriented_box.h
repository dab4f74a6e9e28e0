// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <span>

#include "mesh/box3.h"
#include "mesh/predicates.h"

namespace loft {

/// How a triangle lies: unit vectors along its longest edge and across its face; 0 where it has
/// none.
struct Lie {
  Vec3 along{};
  Vec3 across{};
};

[[nodiscard]] Lie lie_of(const Corners& triangle);

/// A box in space that is turned as what it holds lies, together with the axis-parallel one. Around
/// long thin triangles side by side it is as narrow as they are together, however they run; an
/// axis-parallel box is as wide as they are long, and meets the boxes of all that are near.
/// Made of floating point, and larger by as much as that may err.
class OrientedBox {
 public:
  /// Holds nothing, in the frame of the axes.
  OrientedBox();
  /// Holds nothing, in the frame that triangles with this lie, or this sum of lies, suggest.
  explicit OrientedBox(const Lie& lie);
  /// The box around some points, in a frame that they suggest.
  explicit OrientedBox(std::span<const Vec3> points);

  void add(const Vec3& point);
  [[nodiscard]] const Box3& box() const { return box_; }

  /// How far it would have to grow, along its axes, to hold a triangle.
  [[nodiscard]] double growth(const Corners& triangle) const;
  /// The square of the distance from its middle to a point.
  [[nodiscard]] double squared_distance(const Vec3& point) const;

  /// False if no point of either is in the other. May be true of boxes that are apart.
  friend bool may_meet(const OrientedBox& a, const OrientedBox& b) {
    return boxes_meet(a.box_, b.box_) && !is_apart(a, b) && !is_apart(b, a);
  }

 private:
  static bool is_apart(const OrientedBox& a, const OrientedBox& b);

  Box3 box_;
  std::array<Vec3, 3> axes_;  // unit vectors at right angles
  Vec3 low_;                  // along these
  Vec3 high_;
  double largest_ = 0;  // magnitude of a coordinate: what rounding is measured by
};

/// Adds a lie to a sum of lies that run along each other either way.
void add_lie(Lie& sum, const Lie& lie);

}  // namespace loft
