// SPDX-License-Identifier: MIT
#include "paths/exact_distance.h"

#include <cmath>

#include "cdt/expansion.h"
#include "paths/distance.h"

namespace loft::paths {

using cdt::exact_diff;
using cdt::Expansion;

namespace {

/// How far apart two sides of a comparison must be for their rounding, of some operations, not to
/// matter.
constexpr double clear = 1 - 0x1p-48;

[[nodiscard]] Expansion<2> square_of(double a) { return Expansion<2>(cdt::two_product(a, a)); }

template <std::size_t N>
[[nodiscard]] Expansion<2 * N * N> square_of(const Expansion<N>& a) {
  return a * a;
}

}  // namespace

bool is_as_far(Point p, Point q, double distance) {
  const double x = p.x - q.x;
  const double y = p.y - q.y;
  const double square = x * x + y * y;
  const double asked = distance * distance;
  if (asked < clear * square) return true;
  if (square < clear * asked) return false;
  const auto exact = square_of(exact_diff(p.x, q.x)) + square_of(exact_diff(p.y, q.y));
  return (exact - square_of(distance)).sign() >= 0;
}

bool is_as_far_from_line(Point p, Point a, Point b, double distance) {
  const double x = b.x - a.x;
  const double y = b.y - a.y;
  const double one = x * (p.y - a.y);
  const double other = y * (p.x - a.x);
  const double twice_area = std::abs(one - other);
  const double error = 0x1p-50 * (std::abs(one) + std::abs(other));
  const double asked = distance * std::sqrt(x * x + y * y);
  if (asked < clear * (twice_area - error)) return true;
  if (twice_area + error < clear * asked) return false;
  const auto ab_x = exact_diff(b.x, a.x);
  const auto ab_y = exact_diff(b.y, a.y);
  const auto cross = ab_x * exact_diff(p.y, a.y) - ab_y * exact_diff(p.x, a.x);
  const auto length = square_of(ab_x) + square_of(ab_y);
  return (square_of(cross) - length * square_of(distance)).sign() >= 0;
}

bool is_as_far_from_segment(Point p, Point a, Point b, double distance) {
  if (!is_as_far(p, a, distance) || !is_as_far(p, b, distance)) return false;
  return !has_foot_between(p, a, b) || is_as_far_from_line(p, a, b, distance);
}

}  // namespace loft::paths
