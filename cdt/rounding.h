// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

#include "cdt/point.h"
#include "cdt/predicates.h"

namespace loft::cdt {

// How near is within rounding.

/// Coordinates of crossings are off by half a unit in the last place: within so many of these,
/// relative to the coordinates, are the places that an edit may have to do with.
inline constexpr double doubtful_rounding = 16 * detail::rounding;

/// What rounds to places further apart than so many of these, relative to the coordinates, is told
/// apart by angles that are not thin.
inline constexpr double crowded_rounding = 1024 * detail::rounding;
inline constexpr double thin = 1.0 / 256;

/// A segment may be led astray by rounding that often before it settles for existing edges.
inline constexpr int most_detours = 32;

/// How far the course of the segment ab may be from it.
[[nodiscard]] inline double most_astray(Point a, Point b) {
  return 8 * detail::rounding *
         std::max({std::abs(a.x), std::abs(a.y), std::abs(b.x), std::abs(b.y)});
}

[[nodiscard]] inline double distance(Point p, Point q) { return std::hypot(p.x - q.x, p.y - q.y); }

/// How far p is from the line through a and b, which are different.
[[nodiscard]] inline double distance_to_line(Point a, Point b, Point p) {
  return std::abs((b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x)) / distance(a, b);
}

[[nodiscard]] inline double distance_to_segment(Point a, Point b, Point p) {
  const Point way{b.x - a.x, b.y - a.y};
  const double along = (p.x - a.x) * way.x + (p.y - a.y) * way.y;
  if (!(along > 0)) return distance(a, p);
  if (along >= way.x * way.x + way.y * way.y) return distance(b, p);
  return distance_to_line(a, b, p);
}

/// Whether two places are so near that rounding may have exchanged them along a line.
[[nodiscard]] inline bool are_hardly_apart(Point p, Point q, double slack = doubtful_rounding) {
  const double reach = std::max(std::abs(p.x), std::abs(p.y));
  return std::abs(p.x - q.x) + std::abs(p.y - q.y) <= slack * reach;
}

/// Whether p is beside the segment ab, however far, and not before or behind it.
[[nodiscard]] inline bool is_alongside(Point a, Point b, Point p) {
  const double dx = b.x - a.x;
  const double dy = b.y - a.y;
  return (p.x - a.x) * dx + (p.y - a.y) * dy > 0 && (p.x - b.x) * dx + (p.y - b.y) * dy < 0;
}

/// Whether p is neither within rounding of the line ab nor in a direction from a or b that is
/// almost that of the line. `reach`: a bound for coordinates.
[[nodiscard]] inline bool is_clearly_beside(Point a, Point b, Point p, double reach) {
  const double area = std::abs((a.x - p.x) * (b.y - p.y) - (a.y - p.y) * (b.x - p.x));
  const double length = std::abs(b.x - a.x) + std::abs(b.y - a.y);
  const double longer = std::max(std::abs(p.x - a.x) + std::abs(p.y - a.y),
                                 std::abs(p.x - b.x) + std::abs(p.y - b.y));
  return area > length * std::max(thin * longer, crowded_rounding * reach);
}

/// What is_clearly_beside() an edge, told from fewer operations.
class Strip {
 public:
  /// `reach`: a bound for the squares of coordinates.
  Strip(Point a, Point b, double reach)
      : start_(a),
        way_{b.x - a.x, b.y - a.y},
        length_(way_.x * way_.x + way_.y * way_.y),
        near_(crowded_rounding * crowded_rounding * reach) {}

  /// Where it says no, or there is infinity, nothing is known. In squares: a length in steps along
  /// the axes is at most twice that as the crow flies, and the way from b at most twice those from
  /// a and along ab.
  [[nodiscard]] bool is_far_from(Point p) const {
    const double x = p.x - start_.x;
    const double y = p.y - start_.y;
    const double area = way_.x * y - way_.y * x;
    return area * area > length_ * (9 * thin * thin * (length_ + x * x + y * y) + 3 * near_);
  }

 private:
  Point start_;
  Point way_;
  double length_;
  double near_;
};

/// Whether p is left of the line through a and b, and not crowding it.
[[nodiscard]] inline bool is_clearly_left(Point a, Point b, Point p) {
  const double left = (a.x - p.x) * (b.y - p.y);
  const double right = (a.y - p.y) * (b.x - p.x);
  const double reach = std::max(std::abs(p.x), std::abs(p.y));
  return left - right >
         detail::orient_bound * (std::abs(left) + std::abs(right)) +
             2 * crowded_rounding * reach * (std::abs(b.x - a.x) + std::abs(b.y - a.y));
}

/// Whether a triangle is counter-clockwise and each of its corners is_clearly_left() of the other
/// two: none of its sides is longer, in steps along the axes, than those at p together.
[[nodiscard]] inline bool is_clear_triangle(Point a, Point b, Point p) {
  const auto reach_of = [](Point q) { return std::max(std::abs(q.x), std::abs(q.y)); };
  const Point to_a{a.x - p.x, a.y - p.y};
  const Point to_b{b.x - p.x, b.y - p.y};
  const double left = to_a.x * to_b.y;
  const double right = to_a.y * to_b.x;
  const double reach = std::max({reach_of(a), reach_of(b), reach_of(p)});
  const double length = std::abs(to_a.x) + std::abs(to_a.y) + std::abs(to_b.x) + std::abs(to_b.y);
  return left - right > 2 * detail::orient_bound * (std::abs(left) + std::abs(right)) +
                            2.5 * crowded_rounding * reach * length;
}

/// Whether p is beside the segment ab, between its ends, and so near that rounding a and b may have
/// put it on the wrong side.
[[nodiscard]] inline bool is_hardly_beside(Point a, Point b, Point p, double slack = 1) {
  const double dx = b.x - a.x;
  const double dy = b.y - a.y;
  const double left = dx * (p.y - a.y);
  const double right = dy * (p.x - a.x);
  const double reach = std::max(std::abs(p.x), std::abs(p.y));
  const double bound = slack * doubtful_rounding * reach * (std::abs(dx) + std::abs(dy)) +
                       detail::orient_bound * (std::abs(left) + std::abs(right));
  return std::abs(left - right) <= bound && is_alongside(a, b, p);
}

/// Whether p is so near to the line ab, or to a or b, that others may be hardly beside it.
[[nodiscard]] inline bool is_crowding(Point a, Point b, Point p) {
  const double left = (a.x - p.x) * (b.y - p.y);
  const double right = (a.y - p.y) * (b.x - p.x);
  const double reach = std::max(std::abs(p.x), std::abs(p.y));
  return std::abs(left - right) <=
         2 * crowded_rounding * reach * (std::abs(b.x - a.x) + std::abs(b.y - a.y)) +
             detail::orient_bound * (std::abs(left) + std::abs(right));
}

/// From a place to another: their difference, and its length in steps along the axes.
struct Spoke {
  double x;
  double y;
  double length;

  Spoke(Point from, Point to)
      : x(to.x - from.x), y(to.y - from.y), length(std::abs(x) + std::abs(y)) {}
};

/// Whether the place that both start from is neither is_crowding() the edge between their ends nor
/// hardly apart from these by crowded_rounding, told from fewer operations. `near`: the latter
/// times the largest coordinate of the place. Where it says no, or there is infinity, nothing is
/// known.
[[nodiscard]] inline bool is_clear_of_crowds(const Spoke& a, const Spoke& b, double near) {
  return std::abs(a.x * b.y - a.y * b.x) >
         2.5 * near * (a.length + b.length) + 2 * detail::orient_bound * a.length * b.length;
}

/// The same from squares. With s for the sum of both, |a| + |b| is at most 2 sqrt(s) in steps along
/// the axes, and |a| |b| at most s. So the bound above is less than 5 n sqrt(s) + 10 u s, with n
/// for `near` and u for detail::rounding, and its square than 50 n^2 s + 200 u^2 s^2.
[[nodiscard]] inline bool is_clear_of_crowds(const detail::Sight& a, const detail::Sight& b,
                                             double near) {
  constexpr double by_squares = 220 * detail::rounding * detail::rounding;
  const double area = a.x * b.y - a.y * b.x;
  const double squares = a.lift + b.lift;
  return area * area > squares * (52 * near * near + by_squares * squares);
}

/// Whether p, which is_crowding() the edge ab, does so between a and b or beside them, so that
/// there may be vertices hardly apart from p: these are its neighbours or behind such an edge.
[[nodiscard]] inline bool is_crowding_between(Point a, Point b, Point p) {
  const double margin = 4 * crowded_rounding * std::max(std::abs(p.x), std::abs(p.y));
  const auto is_within = [&](double from, double to, double x) {
    return std::min(from, to) - margin <= x && x <= std::max(from, to) + margin;
  };
  return is_within(a.x, b.x, p.x) && is_within(a.y, b.y, p.y);
}

/// Whether no coordinate of p is beyond those of a and b. Nothing else is_ahead() of the one on the
/// way to the other.
[[nodiscard]] inline bool is_boxed(Point a, Point b, Point p) {
  return (p.x - a.x) * (p.x - b.x) <= 0 && (p.y - a.y) * (p.y - b.y) <= 0;
}

/// Whether q comes after p on the way from a to b, where both are on that line but for correct
/// rounding, which keeps the order of each coordinate.
[[nodiscard]] inline bool is_ahead(Point p, Point q, Point a, Point b) {
  const auto keeps = [](double from, double to, double start, double end) {
    return start <= end ? from <= to : from >= to;
  };
  return p != q && keeps(p.x, q.x, a.x, b.x) && keeps(p.y, q.y, a.y, b.y);
}

}  // namespace loft::cdt
