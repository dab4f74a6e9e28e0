// SPDX-License-Identifier: MIT
#include "mesh/oriented_box.h"

#include <algorithm>
#include <cmath>

#include "mesh/vec3.h"

namespace loft {

namespace {

/// In its length: a triangle of less height is thin.
constexpr double thin = 0.25;
/// In lengths of what it holds: a larger box need not be turned, as what asks for it is no larger.
constexpr double large = 8;

/// Of a sum of a few products with unit vectors, in magnitudes of coordinates: about 30 roundings.
constexpr double rounding = 0x1p-47;

double largest(const Vec3& a) { return std::max({std::abs(a[0]), std::abs(a[1]), std::abs(a[2])}); }

/// 0 of what has no direction. The scale first: squares of large numbers are not finite.
Vec3 unit(const Vec3& a) {
  const double scale = largest(a);
  if (!(scale > 0) || !std::isfinite(scale)) return {};
  const Vec3 scaled{a[0] / scale, a[1] / scale, a[2] / scale};
  const double size = length(scaled);
  return {scaled[0] / size, scaled[1] / size, scaled[2] / size};
}

double largest(const Box3& box) { return std::max(largest(box.low), largest(box.high)); }

double extent(const Box3& box) { return largest(minus(box.high, box.low)); }

/// The part of a at a right angle to a unit vector.
Vec3 beside(const Vec3& a, const Vec3& axis) { return along(a, -dot(a, axis), axis); }

std::array<Vec3, 3> frame_of(const Lie& lie) {
  const Vec3 first = unit(lie.along);
  if (first == Vec3{}) return frame_of_axes;
  Vec3 rest = beside(unit(lie.across), first);
  for (std::size_t axis = 0; axis < 3 && largest(rest) < 0.1; ++axis)
    rest = beside(frame_of_axes[axis], first);
  const Vec3 third = unit(beside(unit(rest), first));
  return {first, unit(cross(third, first)), third};
}

void add_along(Vec3& sum, const Vec3& way) {
  const double sign = dot(sum, way) < 0 ? -1 : 1;
  sum = along(sum, sign, way);
}

}  // namespace

Lie lie_of(const Corners& t) {
  const std::array edges{minus(t[1], t[0]), minus(t[2], t[1]), minus(t[0], t[2])};
  std::size_t longest = 0;
  for (std::size_t i = 1; i < 3; ++i)
    if (squared_length(edges[i]) > squared_length(edges[longest])) longest = i;
  const Vec3 across = cross(edges[0], edges[1]);
  const double square = squared_length(edges[longest]);
  if (!(squared_length(across) < thin * thin * square * square)) return {};
  return {unit(edges[longest]), unit(across), std::sqrt(square)};
}

void add_lie(Lie& sum, const Lie& lie) {
  add_along(sum.along, lie.along);
  add_along(sum.across, lie.across);
  sum.length += lie.length;
}

Lie lie_of_most(const Lie& sum, std::size_t count, const Box3& box) {
  const auto all = static_cast<double>(count);
  const bool is_alike = squared_length(sum.along) > all * all / 4;
  return is_alike && extent(box) < large * sum.length / all ? sum : Lie{};
}

TurnedBox::TurnedBox(const Lie& lie) : axes_(frame_of(lie)), low_(no_box.low), high_(no_box.high) {}

bool TurnedBox::is_apart(const Box3& around, const Box3& other) const {
  const double slack = rounding * (largest(around) + largest(other));
  const Vec3 sums = along(other.low, 1, other.high);
  const Vec3 sizes = minus(other.high, other.low);
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3& axis = axes_[i];
    const double middle = dot(axis, sums) / 2;
    const double half = slack + (std::abs(axis[0]) * sizes[0] + std::abs(axis[1]) * sizes[1] +
                                 std::abs(axis[2]) * sizes[2]) /
                                    2;
    if (middle - half > high_[i] || middle + half < low_[i]) return true;
  }
  return false;
}

bool TurnedBox::is_apart(const Box3& around, const TurnedBox& turned, const Box3& other) const {
  const double slack = rounding * (largest(around) + largest(other));
  for (std::size_t i = 0; i < 3; ++i) {
    double middle = 0;
    double half = slack;
    for (std::size_t j = 0; j < 3; ++j) {
      const double share = dot(axes_[i], turned.axes_[j]);
      middle += share * (turned.low_[j] + turned.high_[j]) / 2;
      half += std::abs(share) * (turned.high_[j] - turned.low_[j]) / 2;
    }
    if (middle - half > high_[i] || middle + half < low_[i]) return true;
  }
  return false;
}

bool TurnedBox::passes(const Box3& around, const TurnedBox& turned, const Box3& other) const {
  const Vec3 way = cross(axes_[0], turned.axes_[0]);
  const double slack = 4 * rounding * (largest(around) + largest(other));
  double middle = 0;  // of the other one, from that of this one
  double half = slack;
  for (std::size_t i = 0; i < 3; ++i) {
    const double own = dot(way, axes_[i]);
    const double others = dot(way, turned.axes_[i]);
    middle += (others * (turned.low_[i] + turned.high_[i]) - own * (low_[i] + high_[i])) / 2;
    half += (std::abs(others) * (turned.high_[i] - turned.low_[i]) +
             std::abs(own) * (high_[i] - low_[i])) /
            2;
  }
  return std::abs(middle) > half;
}

bool TurnedBox::is_apart(const Box3& around, const Corners& triangle, const Box3& other) const {
  const double slack = rounding * (largest(around) + largest(other));
  for (std::size_t i = 0; i < 3; ++i) {
    const auto [low, high] = std::minmax(
        {dot(axes_[i], triangle[0]), dot(axes_[i], triangle[1]), dot(axes_[i], triangle[2])});
    if (low - slack > high_[i] || high + slack < low_[i]) return true;
  }
  return false;
}

Lie lie_of_points(std::span<const Vec3> points) {
  Lie lie;
  for (const Vec3& p : points) {
    const Vec3 way = minus(p, points.front());
    if (largest(way) <= lie.length) continue;
    lie.length = largest(way);
    lie.along = way;
  }
  lie.along = unit(lie.along);
  double furthest = 0;
  for (const Vec3& p : points) {
    const Vec3 way = beside(minus(p, points.front()), lie.along);
    if (largest(way) <= furthest) continue;
    furthest = largest(way);
    lie.across = way;
  }
  if (!(furthest < thin * lie.length)) return {};
  lie.across = cross(lie.along, unit(lie.across));
  return lie;
}

OrientedBox::OrientedBox(std::span<const Vec3> points) {
  for (const Vec3& p : points) box = extended(box, p);
  const Lie lie = lie_of_points(points);
  is_turned = lie.length > 0;
  if (!is_turned) return;
  turned = TurnedBox(lie);
  for (const Vec3& p : points) turned.add(p);
}

}  // namespace loft
