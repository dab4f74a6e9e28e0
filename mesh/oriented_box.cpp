// SPDX-License-Identifier: MIT
#include "mesh/oriented_box.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesh/vec3.h"

namespace loft {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::array<Vec3, 3> frame_of_axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

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
  std::array edges{minus(t[1], t[0]), minus(t[2], t[1]), minus(t[0], t[2])};
  std::ranges::sort(edges, std::ranges::greater{}, [](const Vec3& e) { return largest(e); });
  const Vec3 longest = unit(edges[0]);
  return {longest, unit(cross(longest, unit(edges[1])))};
}

void add_lie(Lie& sum, const Lie& lie) {
  add_along(sum.along, lie.along);
  add_along(sum.across, lie.across);
}

OrientedBox::OrientedBox() : OrientedBox(Lie{}) {}

OrientedBox::OrientedBox(const Lie& lie)
    : box_{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}},
      axes_(frame_of(lie)),
      low_(box_.low),
      high_(box_.high) {}

OrientedBox::OrientedBox(std::span<const Vec3> points) {
  Lie lie;
  double longest = 0;
  for (const Vec3& p : points) {
    const Vec3 way = minus(p, points.front());
    if (largest(way) <= longest) continue;
    longest = largest(way);
    lie.along = unit(way);
  }
  double furthest = 0;
  for (const Vec3& p : points) {
    const Vec3 way = beside(minus(p, points.front()), lie.along);
    if (largest(way) <= furthest) continue;
    furthest = largest(way);
    lie.across = cross(lie.along, unit(way));
  }
  *this = OrientedBox(lie);
  for (const Vec3& p : points) add(p);
}

void OrientedBox::add(const Vec3& point) {
  box_ = joined(box_, {point, point});
  largest_ = std::max(largest_, largest(point));
  for (std::size_t i = 0; i < 3; ++i) {
    const double at = dot(axes_[i], point);
    low_[i] = std::min(low_[i], at);
    high_[i] = std::max(high_[i], at);
  }
}

double OrientedBox::growth(const Corners& triangle) const {
  double result = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    double low = low_[i];
    double high = high_[i];
    for (const Vec3& p : triangle) {
      low = std::min(low, dot(axes_[i], p));
      high = std::max(high, dot(axes_[i], p));
    }
    result += (low_[i] - low) + (high - high_[i]);
  }
  return result;
}

double OrientedBox::squared_distance(const Vec3& point) const {
  double result = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double way = dot(axes_[i], point) - (low_[i] + high_[i]) / 2;
    result += way * way;
  }
  return result;
}

/// Whether an axis of a shows them apart.
bool OrientedBox::is_apart(const OrientedBox& a, const OrientedBox& b) {
  const double slack = rounding * (a.largest_ + b.largest_);
  for (std::size_t i = 0; i < 3; ++i) {
    double middle = 0;
    double half = slack;
    for (std::size_t j = 0; j < 3; ++j) {
      const double share = dot(a.axes_[i], b.axes_[j]);
      middle += share * (b.low_[j] + b.high_[j]) / 2;
      half += std::abs(share) * (b.high_[j] - b.low_[j]) / 2;
    }
    if (middle - half > a.high_[i] || middle + half < a.low_[i]) return true;
  }
  return false;
}

}  // namespace loft
