// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include "mesh/box3.h"
#include "mesh/predicates.h"

namespace loft {

inline constexpr std::array<Vec3, 3> frame_of_axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

/// How a long thin triangle lies: unit vectors along its longest edge and across its face, and how
/// long it is. All 0 of others, which boxes along the axes are good enough for.
struct Lie {
  Vec3 along{};
  Vec3 across{};
  double length = 0;
};

[[nodiscard]] Lie lie_of(const Corners& triangle);

/// Adds a lie to a sum of lies that run along each other either way.
void add_lie(Lie& sum, const Lie& lie);

/// How some triangles lie together, in a box along the axes: like none, unless most are long and
/// thin and run one way, and the box is not much larger than they are.
[[nodiscard]] Lie lie_of_most(const Lie& sum, std::size_t count, const Box3& box);

/// A box that is turned as what it holds lies. Around long thin triangles side by side it is as
/// narrow as they are together, however they run; an axis-parallel box is as wide as they are long,
/// and meets the boxes of all that are near.
/// Made of floating point, and larger by as much as that may err.
class TurnedBox {
 public:
  TurnedBox() = default;
  /// Holds nothing. Precondition: the lie has a length.
  explicit TurnedBox(const Lie& lie);

  /// Holds nothing from then on, and stays turned.
  void clear() {
    low_ = no_box.low;
    high_ = no_box.high;
  }

  void add(const Vec3& point) {
    for (std::size_t i = 0; i < 3; ++i) {
      const double at = axes_[i][0] * point[0] + axes_[i][1] * point[1] + axes_[i][2] * point[2];
      low_[i] = std::min(low_[i], at);
      high_[i] = std::max(high_[i], at);
    }
  }

  /// To either side of each axis.
  void grow(double reach) {
    for (double& x : low_) x -= reach;
    for (double& x : high_) x += reach;
  }

  /// Unit vectors at right angles.
  [[nodiscard]] const std::array<Vec3, 3>& axes() const { return axes_; }

  /// Whether an axis of it shows that it is apart from a box along the axes, or from a turned one.
  /// `around`, `other`: boxes along the axes around what it, and the other one, holds.
  [[nodiscard]] bool is_apart(const Box3& around, const Box3& other) const;
  [[nodiscard]] bool is_apart(const Box3& around, const TurnedBox& turned, const Box3& other) const;
  /// Whether the axis at right angles to the first ones of both shows two turned ones apart: long
  /// thin ones that pass each other.
  [[nodiscard]] bool passes(const Box3& around, const TurnedBox& turned, const Box3& other) const;
  /// Whether an axis of it shows that it is apart from a triangle.
  [[nodiscard]] bool is_apart(const Box3& around, const Corners& triangle, const Box3& other) const;

 private:
  std::array<Vec3, 3> axes_{};  // unit vectors at right angles
  Vec3 low_{};                  // along these
  Vec3 high_{};
};

/// How some points lie together, as lie_of_most(): like none unless they are long and thin.
[[nodiscard]] Lie lie_of_points(std::span<const Vec3> points);

/// A box along the axes and, around what is long and thin, a turned one.
struct OrientedBox {
  explicit OrientedBox(std::span<const Vec3> points);

  Box3 box = no_box;
  bool is_turned = false;
  TurnedBox turned;
};

}  // namespace loft
