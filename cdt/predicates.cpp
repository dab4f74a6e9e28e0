// SPDX-License-Identifier: MIT
#include "cdt/predicates.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <limits>

#include "cdt/expansion.h"

namespace loft::cdt {

namespace {

struct ExactVector {
  Expansion<2> x;
  Expansion<2> y;
};

ExactVector difference(Point a, Point b) { return {exact_diff(a.x, b.x), exact_diff(a.y, b.y)}; }

Expansion<16> cross(const ExactVector& a, const ExactVector& b) { return a.x * b.y - a.y * b.x; }

Expansion<16> squared_length(const ExactVector& a) { return a.x * a.x + a.y * a.y; }

/// Twice the signed area of the triangle a, b, c.
Expansion<16> area(Point a, Point b, Point c) { return cross(difference(a, c), difference(b, c)); }

bool is_odd(double value) { return (std::bit_cast<std::uint64_t>(value) & 1) != 0; }

/// A fraction, and its value rounded to double.
struct Quotient {
  Expansion<64> numerator;
  Expansion<16> denominator;

  /// The sign of the exact value less a + b.
  [[nodiscard]] int compared_with(TwoTerms sum) const {
    return (numerator - denominator * Expansion<2>(sum)).sign() * denominator.sign();
  }

  /// Whether the value is nearer to `next`, the neighbour of `value`, or as near but `next` is
  /// even.
  [[nodiscard]] bool prefers(double value, double next) const {
    const int direction = next > value ? 1 : -1;
    const int side = direction * compared_with(two_sum(value, (next - value) / 2));
    return side > 0 || (side == 0 && is_odd(value));
  }

  /// From a double near the value, step by step to the nearest.
  [[nodiscard]] double rounded_from(double guess) const {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    while (true) {
      const double above = std::nextafter(guess, infinity);
      const double below = std::nextafter(guess, -infinity);
      if (prefers(guess, above)) {
        guess = above;
      } else if (prefers(guess, below)) {
        guess = below;
      } else {
        return guess;
      }
    }
  }

  /// To nearest, even.
  [[nodiscard]] double rounded() const {
    if (numerator.sign() == 0) return 0;  // never -0
    const double divisor = denominator.estimate();
    const double guess = numerator.estimate() / divisor;
    const double correction = (numerator - denominator * guess).estimate() / divisor;
    // The guess is off by less than 8 roundings, and so is the correction, relatively: if the sum
    // of both rounds to one double all over that range, this is the one.
    const auto [high, low] = two_sum(guess, correction);
    const double slack = 8 * detail::rounding * std::abs(correction);
    if (high + (low - slack) == high && high + (low + slack) == high) return high;
    return rounded_from(high);
  }
};

}  // namespace

namespace detail {

int orient_exact(Point a, Point b, Point c) { return area(a, b, c).sign(); }

int in_circle_exact(Point a, Point b, Point c, Point d) {
  const ExactVector ad = difference(a, d);
  const ExactVector bd = difference(b, d);
  const ExactVector cd = difference(c, d);
  const auto a_part = squared_length(ad) * cross(bd, cd);
  const auto b_part = squared_length(bd) * cross(cd, ad);
  const auto c_part = squared_length(cd) * cross(ad, bd);
  return (a_part + b_part + c_part).sign();
}

/// in_circle is the sign of the determinant with the rows (x, y, height, 1) of a, b, c and d.
/// Raising one point's height changes it in proportion to its cofactor: the orientation of the
/// other three points, with alternating sign. The point raised most decides, unless its cofactor
/// is 0; then the next one does.
int break_tie(Point a, Point b, Point c, Point d) {
  struct Corner {
    Point place;
    Point others[3];  ///< in the order in which raising this point counts as their orientation
  };
  std::array<Corner, 4> corners{{
      {a, {b, c, d}},
      {b, {a, d, c}},
      {c, {a, b, d}},
      {d, {a, c, b}},
  }};
  std::ranges::sort(corners, [](const Corner& p, const Corner& q) { return q.place < p.place; });
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
    if (corners[i].place == corners[i + 1].place) return 0;
  }
  for (const auto& [place, others] : corners) {
    const int side = orient(others[0], others[1], others[2]);
    if (side != 0) return side;
  }
  return 0;
}

}  // namespace detail

bool crosses(Point a, Point b, Point c, Point d) {
  return orient(a, b, c) * orient(a, b, d) < 0 && orient(c, d, a) * orient(c, d, b) < 0;
}

/// The point divides ab in the ratio of the distances of a and b from the line cd, with sign.
Point intersection(Point a, Point b, Point c, Point d) {
  const Expansion<16> to_a = area(c, d, a);
  const Expansion<16> to_b = area(c, d, b);
  const Expansion<16> across = cross(difference(d, c), difference(a, b));  // to_a - to_b
  return {Quotient{to_a * b.x - to_b * a.x, across}.rounded(),
          Quotient{to_a * b.y - to_b * a.y, across}.rounded()};
}

}  // namespace loft::cdt
