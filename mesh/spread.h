// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "mesh/box3.h"
#include "mesh/predicates.h"
#include "mesh/vec3.h"

namespace loft {

/// From where to where something is along an axis.
struct Extent {
  double low;
  double high;

  [[nodiscard]] double twice_middle() const { return low + high; }
};

[[nodiscard]] inline Extent extent(const Corners& t, const Vec3& axis) {
  const double a = dot(axis, t[0]);
  const double b = dot(axis, t[1]);
  const double c = dot(axis, t[2]);
  return {std::min(std::min(a, b), c), std::max(std::max(a, b), c)};
}

/// Whether most of some things have one middle along an axis: divided there, though a few be far
/// off, they fall into two boxes that have nearly everything in common.
/// `median`: that of the middles.
template <class Things, class Middle>
[[nodiscard]] bool are_most_alike(const Things& things, double median, Middle middle) {
  const auto alike =
      std::ranges::count_if(things, [&](const auto& thing) { return middle(thing) == median; });
  return 2 * static_cast<std::size_t>(alike) > std::ranges::size(things);
}

/// Along which of three axes some things are spread out most: whatever is divided there falls into
/// two boxes that have little in common. Of long thin things side by side that is across them,
/// though they be longer than all are wide together: there their middles are spread out over most
/// of their widths.
class Spread {
 public:
  explicit Spread(const std::array<Vec3, 3>& axes) : axes_(axes) {}

  /// Where a thing is along each axis.
  void add(const std::array<Extent, 3>& extents) {
    Vec3 middle;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      middle[axis] = extents[axis].twice_middle();
      widths_[axis] += extents[axis].high - extents[axis].low;
    }
    middles_ = extended(middles_, middle);
  }
  void add(const Corners& t) {
    add({extent(t, axes_[0]), extent(t, axes_[1]), extent(t, axes_[2])});
  }

  /// The axes, that of the largest spread first.
  [[nodiscard]] std::array<Vec3, 3> by_spread() const {
    return sorted([](std::size_t) { return 1.0; });
  }
  [[nodiscard]] std::array<Vec3, 3> by_spread_in_widths() const {
    // In widths of the widest: what is less may be rounding.
    constexpr double rounding = 0x1p-20;
    const double least = rounding * *std::ranges::max_element(widths_);
    return sorted([&](std::size_t axis) { return std::max(widths_[axis], least); });
  }

 private:
  template <class Unit>
  [[nodiscard]] std::array<Vec3, 3> sorted(Unit unit) const {
    const Vec3 spreads = minus(middles_.high, middles_.low);
    std::array<std::size_t, 3> order{0, 1, 2};
    const auto is_before = [&](std::size_t a, std::size_t b) {
      return spreads[a] * unit(b) > spreads[b] * unit(a);
    };
    if (is_before(order[1], order[0])) std::swap(order[0], order[1]);
    if (is_before(order[2], order[0])) std::swap(order[0], order[2]);
    if (is_before(order[2], order[1])) std::swap(order[1], order[2]);
    return {axes_[order[0]], axes_[order[1]], axes_[order[2]]};
  }

  std::array<Vec3, 3> axes_;
  Box3 middles_ = no_box;
  Vec3 widths_{};
};

}  // namespace loft
