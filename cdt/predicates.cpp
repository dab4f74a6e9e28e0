// SPDX-License-Identifier: MIT
#include "cdt/predicates.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <optional>

#include "cdt/expansion.h"

namespace loft::cdt {

namespace {

// --- Twice the precision: much faster than exact, and nearly always enough ---

inline TwoTerms operator+(TwoTerms a, TwoTerms b) {
  const auto [high, low] = two_sum(a.high, b.high);
  return two_sum(high, low + (a.low + b.low));
}

inline TwoTerms operator-(TwoTerms a, TwoTerms b) { return a + TwoTerms{-b.high, -b.low}; }

inline TwoTerms operator*(TwoTerms a, TwoTerms b) {
  const auto [high, low] = two_product(a.high, b.high);
  return fast_two_sum(high, low + (a.high * b.low + a.low * b.high));
}

/// A bound for the error of fewer than 16 of these operations in a row, relative to the sum of the
/// absolute values of what is added up. (One operation errs by less than 2^-103 of that.)
constexpr double doubled_rounding = 0x1p-98;

// --- The determinants, for any kind of number ---

template <class Number>
struct Vector {
  Number x;
  Number y;
};

using ExactVector = Vector<Expansion<2>>;

/// Without error.
Vector<TwoTerms> difference(Point a, Point b) { return {two_diff(a.x, b.x), two_diff(a.y, b.y)}; }

ExactVector exact(const Vector<TwoTerms>& a) { return {Expansion<2>(a.x), Expansion<2>(a.y)}; }

/// Whether one term each is enough.
bool is_short(const Vector<TwoTerms>& a) { return a.x.low == 0 && a.y.low == 0; }

/// Which of two results of operations is larger: rounding keeps their order.
int compare(TwoTerms a, TwoTerms b) {
  if (a.high != b.high) return a.high > b.high ? 1 : -1;
  return a.low == b.low ? 0 : a.low > b.low ? 1 : -1;
}

/// A bound for the length, in plain precision.
double reach(const Vector<TwoTerms>& a) { return std::abs(a.x.high) + std::abs(a.y.high); }

/// The largest power of two of which the number is a multiple; infinity for 0.
double unit(double a) {
  if (a == 0) return std::numeric_limits<double>::infinity();
  constexpr std::uint64_t fraction = (std::uint64_t{1} << 52) - 1;
  const auto bits = std::bit_cast<std::uint64_t>(a);
  if ((bits & fraction) == 0) return std::abs(a);
  return std::abs(a - std::bit_cast<double>(bits & (bits - 1)));
}

double unit(const Vector<TwoTerms>& a) {
  return std::min({unit(a.x.high), unit(a.x.low), unit(a.y.high), unit(a.y.low)});
}

template <class Number>
auto cross(const Vector<Number>& a, const Vector<Number>& b) {
  return a.x * b.y - a.y * b.x;
}

template <class Number>
auto squared_length(const Vector<Number>& a) {
  return a.x * a.x + a.y * a.y;
}

/// Positive if the origin is inside the circle through a, b, c (counter-clockwise).
template <class Number>
auto circle_determinant(const Vector<Number>& a, const Vector<Number>& b, const Vector<Number>& c) {
  return squared_length(a) * cross(b, c) + squared_length(b) * cross(c, a) +
         squared_length(c) * cross(a, b);
}

// --- Division ---

/// The double that all numbers within `slack` of the sum round to, if there is one.
std::optional<double> certain_rounding(TwoTerms sum, double slack) {
  const auto [high, low] = two_sum(sum.high, sum.low);
  if (high + (low - slack) == high && high + (low + slack) == high) return high;
  return std::nullopt;
}

/// A number and a bound for its error.
struct Approximate {
  TwoTerms value;
  double error;
};

/// Where products may have underflowed the error is infinite.
Approximate approximate_cross(const Vector<TwoTerms>& a, const Vector<TwoTerms>& b) {
  const double error = doubled_rounding * reach(a) * reach(b);
  const bool is_sound = error >= std::numeric_limits<double>::min();
  return {cross(a, b), is_sound ? error : std::numeric_limits<double>::infinity()};
}

/// Their quotient, where the denominator is certain enough. With D for that and N for the numerator
/// without error, and n / d for the quotient of what is known of them, N / D is off by at most
/// (|N - n| + |n / d| |D - d|) / |D|, where |D| is at least 3/4 |d|. Twice, for rounding that
/// bound.
std::optional<Approximate> quotient(const Approximate& numerator, const Approximate& denominator) {
  const TwoTerms& n = numerator.value;
  const TwoTerms& d = denominator.value;
  const double size = std::abs(d.high);
  if (!(4 * denominator.error < size)) return std::nullopt;
  const double guess = n.high / d.high;
  const double correction = (n - d * TwoTerms{guess, 0}).high / d.high;
  const double error = (numerator.error + std::abs(guess) * denominator.error) / size;
  return Approximate{fast_two_sum(guess, correction),
                     2 * (error + doubled_rounding * std::abs(guess))};
}

/// start + share * way rounded to double where the error of the share leaves no doubt.
std::optional<double> rounded_advance(double start, const Approximate& share, TwoTerms way) {
  if (way.high == 0) return start + 0.0;  // never -0
  const TwoTerms advance = share.value * way;
  const auto [high, low] = two_sum(start, advance.high);
  const double slack = 2 * (std::abs(way.high) * share.error +
                            doubled_rounding * (std::abs(start) + std::abs(advance.high)));
  if (slack < std::numeric_limits<double>::min()) return std::nullopt;  // it has underflowed
  return certain_rounding({high, low + advance.low}, slack);
}

bool is_odd(double value) { return (std::bit_cast<std::uint64_t>(value) & 1) != 0; }

/// Half of the way to the next double in the direction of a sign.
double half_step(double x, int direction) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  return direction == 0 ? 0 : (std::nextafter(x, direction * infinity) - x) / 2;
}

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

  /// To nearest, even: from a double that is off by a few last places at most, step by step.
  [[nodiscard]] double rounded() const {
    if (numerator.sign() == 0) return 0;  // never -0
    constexpr double infinity = std::numeric_limits<double>::infinity();
    double result = numerator.estimate() / denominator.estimate();
    constexpr int most_steps = 64;  // more only where tiny numbers underflow and nothing is exact
    for (int step = 0; step < most_steps; ++step) {
      const double above = std::nextafter(result, infinity);
      const double below = std::nextafter(result, -infinity);
      if (prefers(result, above)) {
        result = above;
      } else if (prefers(result, below)) {
        result = below;
      } else {
        break;
      }
    }
    return result;
  }
};

}  // namespace

namespace detail {

int orient_exact(Point a, Point b, Point c) {
  const auto ac = difference(a, c);
  const auto bc = difference(b, c);
  if (is_short(ac) && is_short(bc))
    return compare(two_product(ac.x.high, bc.y.high), two_product(ac.y.high, bc.x.high));
  const auto [area, error] = approximate_cross(ac, bc);
  if (area.high > error) return 1;
  if (area.high < -error) return -1;
  return cross(exact(ac), exact(bc)).sign();
}

int in_circle_exact(Point a, Point b, Point c, Point d) {
  const auto ad = difference(a, d);
  const auto bd = difference(b, d);
  const auto cd = difference(c, d);
  const double determinant = circle_determinant(ad, bd, cd).high;
  const double reach_a = reach(ad), reach_b = reach(bd), reach_c = reach(cd);
  const double magnitude = reach_a * reach_b * reach_c * (reach_a + reach_b + reach_c);
  const double bound = doubled_rounding * magnitude;
  if (determinant > bound) return 1;
  if (determinant < -bound) return -1;
  // On grids the determinant is a multiple of something, and often certain to be less: a tie.
  const double step = std::min({unit(ad), unit(bd), unit(cd)});
  if (bound + std::abs(determinant) < step * step * step * step) return 0;
  return circle_determinant(exact(ad), exact(bd), exact(cd)).sign();
}

/// What rounds to p is a rectangle around it, its edges included where p is even. If p is left of
/// the line, that one comes nearest to the right of it with one corner.
bool rounds_to_exact(Point a, Point b, Point p) {
  const auto area = cross(exact(difference(a, p)), exact(difference(b, p)));
  const int side = area.sign();
  if (side == 0 || p == a || p == b) return true;
  const auto way = exact(difference(b, a));
  const int right = side * way.y.sign();
  const int down = -side * way.x.sign();
  const auto moved = area + (way.x * half_step(p.y, down) - way.y * half_step(p.x, right));
  if (moved.sign() == 0) return !is_odd(p.x) && !is_odd(p.y);
  return moved.sign() != side;
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

int compare_distances(Point p, Point a, Point b) {
  const auto to_a = squared_length(exact(difference(a, p)));
  const auto to_b = squared_length(exact(difference(b, p)));
  return (to_a - to_b).sign();
}

double exact_distance(Point a, Point b, Point p) {
  const auto from_a = exact(difference(p, a));
  const auto from_b = exact(difference(p, b));
  const auto way = exact(difference(b, a));
  const auto is_ahead = [&](const ExactVector& v) {
    return (v.x * way.x + v.y * way.y).sign() > 0;
  };
  const auto length = [](const ExactVector& v) {
    return std::hypot(v.x.estimate(), v.y.estimate());
  };
  if (!is_ahead(from_a)) return length(from_a);
  if (is_ahead(from_b)) return length(from_b);
  return std::abs(cross(from_a, way).estimate()) / length(way);
}

bool crosses(Point a, Point b, Point c, Point d) {
  return orient(a, b, c) * orient(a, b, d) < 0 && orient(c, d, a) * orient(c, d, b) < 0;
}

/// The point divides ab in the ratio of the distances of a and b from the line cd, with sign.
Point intersection(Point a, Point b, Point c, Point d) {
  const auto line = difference(d, c);
  const auto from_a = difference(a, c);
  const auto way = difference(a, b);
  const auto exactly = [&](double at_a, double at_b) {
    const auto to_a = cross(exact(line), exact(from_a));
    const auto to_b = cross(exact(line), exact(difference(b, c)));
    return Quotient{to_a * at_b - to_b * at_a, cross(exact(line), exact(way))}.rounded();
  };
  const auto share = quotient(approximate_cross(line, from_a), approximate_cross(line, way));
  const auto at = [&](double at_a, double at_b, TwoTerms back) {
    const auto quick =
        share ? rounded_advance(at_a, *share, {-back.high, -back.low}) : std::nullopt;
    return quick ? *quick : exactly(at_a, at_b);
  };
  return {at(a.x, b.x, way.x), at(a.y, b.y, way.y)};
}

}  // namespace loft::cdt
