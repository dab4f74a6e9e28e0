// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "cdt/point.h"

namespace loft::cdt {

/// Exact geometric decisions on points with `double` coordinates, and the one rounded construction.
///
/// Each predicate is a floating-point filter with a derived error bound, then exact arithmetic on
/// expansions (after Shewchuk, "Adaptive Precision Floating-Point Arithmetic and Fast Robust
/// Geometric Predicates", 1997). Exact as long as no product of four (orient: two) coordinate
/// differences over- or underflows. Must be compiled without floating-point contraction.

/// Which side of the line a -> b the point c is on: +1 left, -1 right, 0 exactly on it.
/// Laws: orient(b,c,a) == orient(a,b,c); orient(b,a,c) == -orient(a,b,c);
/// 0 if two of the points are equal.
[[nodiscard]] int orient(Point a, Point b, Point c);

/// Whether d is inside the circle through a, b, c (counter-clockwise): +1 inside, -1 outside,
/// 0 exactly on it. Laws: an even permutation of the four points keeps the sign, an odd one turns
/// it; 0 if two of the points are equal.
[[nodiscard]] int in_circle(Point a, Point b, Point c, Point d);

/// in_circle that never answers 0 for four different points, a, b, c counter-clockwise.
/// Ties are broken as if each point's height on the paraboloid x^2+y^2 were raised by its own
/// infinitesimal, the lexicographically largest point by far the most (Devillers and Teillaud,
/// "Perturbations and Vertex Removal in Delaunay Triangulations", 2003). So the answer depends on
/// the coordinates alone, and every point set has one Delaunay triangulation. Laws: as in_circle;
/// 0 if two of the points are equal or all four are in one line.
[[nodiscard]] int in_circle_perturbed(Point a, Point b, Point c, Point d);

/// Which of a and b is nearer to p: -1 a, +1 b, 0 both are as near. Exact.
[[nodiscard]] int compare_distances(Point p, Point a, Point b);

/// Whether the open segments ab and cd cross in one point that is inside both (exact).
[[nodiscard]] bool crosses(Point a, Point b, Point c, Point d);

/// The intersection of the lines ab and cd, each coordinate correctly rounded (to nearest, even):
/// the result does not depend on the order of a and b, of c and d, or of the two lines.
/// Precondition: the lines are not parallel.
[[nodiscard]] Point intersection(Point a, Point b, Point c, Point d);

/// Whether a point of the segment ab rounds to p: each coordinate to nearest, even. Exact. Laws:
/// true for a and b, for what is exactly on the segment, and for the intersection of two segments
/// that cross; the same for ba as for ab. Of all that round to them, two segments meet the points
/// in the order of both coordinates.
[[nodiscard]] bool rounds_to(Point a, Point b, Point p);

/// How far p is from the segment ab: off by less than 2^-50 of that.
[[nodiscard]] double exact_distance(Point a, Point b, Point p);

namespace detail {

/// The largest relative error of one rounded operation.
inline constexpr double rounding = 0x1p-53;

// The filters all use the same argument. A determinant is a sum of products of coordinate
// differences. Computed as below, each such product goes through at most n roundings (from its
// differences up to the last sum), so it enters with a relative error of at most
// n * rounding / (1 - n * rounding), and the determinant is off by at most that much times the sum
// of the products' absolute values, their `magnitude`. The magnitude's own rounding, and that of
// the bound, are of second order: less than one more `rounding`. Hence (n + 1) * rounding.

/// Two differences, product, sum: 4 roundings.
inline constexpr double orient_bound = 5 * rounding;
/// Four differences, square, sum of squares, product, difference of products, product of both,
/// two sums: 11 roundings.
inline constexpr double in_circle_bound = 12 * rounding;

/// The predicates without filter: for what that cannot decide.
[[nodiscard]] int orient_exact(Point a, Point b, Point c);
[[nodiscard]] int in_circle_exact(Point a, Point b, Point c, Point d);
/// rounds_to where p is no further than a and b in any direction.
[[nodiscard]] bool rounds_to_exact(Point a, Point b, Point p);
/// in_circle_perturbed for four points of which in_circle says 0.
[[nodiscard]] int break_tie(Point a, Point b, Point c, Point d);

}  // namespace detail

inline int orient(Point a, Point b, Point c) {
  const double left = (a.x - c.x) * (b.y - c.y);
  const double right = (a.y - c.y) * (b.x - c.x);
  const double determinant = left - right;
  const double bound = detail::orient_bound * (std::abs(left) + std::abs(right));
  if (determinant > bound) return 1;
  if (determinant < -bound) return -1;
  return detail::orient_exact(a, b, c);
}

inline bool rounds_to(Point a, Point b, Point p) {
  const auto is_between = [](double from, double to, double x) {
    return from <= to ? from <= x && x <= to : to <= x && x <= from;
  };
  if (!is_between(a.x, b.x, p.x) || !is_between(a.y, b.y, p.y)) return false;
  const double left = (a.x - p.x) * (b.y - p.y);
  const double right = (a.y - p.y) * (b.x - p.x);
  // As in orient; and what rounds to p is no further than `rounding` of each coordinate.
  const double bound =
      detail::orient_bound * (std::abs(left) + std::abs(right)) +
      2 * detail::rounding *
          (std::abs(p.x) * std::abs(b.y - a.y) + std::abs(p.y) * std::abs(b.x - a.x));
  return std::abs(left - right) <= bound && detail::rounds_to_exact(a, b, p);
}

namespace detail {

/// The way to a point, and the square of its length.
struct Sight {
  double x, y, lift;
  Sight(Point from, Point to) : x(to.x - from.x), y(to.y - from.y), lift(x * x + y * y) {}
};

/// in_circle of three points and the one that they are seen from; 0 where only exact arithmetic can
/// tell, and where one of them is at infinity. The magnitude is bounded by the lifts A, B and C:
/// |b.x c.y| + |c.x b.y| is at most the product of the two lengths, so at most (B + C) / 2.
inline int in_circle_filter(const Sight& a, const Sight& b, const Sight& c) {
  const double bc = b.x * c.y, cb = c.x * b.y;
  const double ca = c.x * a.y, ac = a.x * c.y;
  const double ab = a.x * b.y, ba = b.x * a.y;
  const double determinant = a.lift * (bc - cb) + b.lift * (ca - ac) + c.lift * (ab - ba);
  const double magnitude = a.lift * (b.lift + c.lift) + b.lift * c.lift;
  const double bound = detail::in_circle_bound * magnitude;
  if (determinant > bound) return 1;
  if (determinant < -bound) return -1;
  return 0;
}

}  // namespace detail

inline int in_circle(Point a, Point b, Point c, Point d) {
  using detail::Sight;
  const int side = detail::in_circle_filter(Sight(d, a), Sight(d, b), Sight(d, c));
  return side != 0 ? side : detail::in_circle_exact(a, b, c, d);
}

inline int in_circle_perturbed(Point a, Point b, Point c, Point d) {
  const int side = in_circle(a, b, c, d);
  return side != 0 ? side : detail::break_tie(a, b, c, d);
}

}  // namespace loft::cdt
