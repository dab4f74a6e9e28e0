// SPDX-License-Identifier: MIT
#include "cdt/predicates.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "cdt/expansion.h"
#include "cdt/rounding.h"

namespace loft::cdt {
namespace {

using Rational = boost::multiprecision::cpp_rational;
using Integer = boost::multiprecision::cpp_int;
using Random = std::mt19937_64;

// --- The slow oracle ---

struct Lifted {
  Rational x, y, height;
};

Lifted lift(Point p) {
  const Rational x(p.x);
  const Rational y(p.y);
  return {x, y, x * x + y * y};
}

Rational area(const Lifted& a, const Lifted& b, const Lifted& c) {
  return (a.x - c.x) * (b.y - c.y) - (a.y - c.y) * (b.x - c.x);
}

int oracle_orient(Point a, Point b, Point c) { return area(lift(a), lift(b), lift(c)).sign(); }

/// The determinant of (x, y, height, 1), by its last two columns.
int oracle_in_circle(const std::array<Lifted, 4>& p) {
  const Rational determinant =
      p[0].height * area(p[1], p[2], p[3]) - p[1].height * area(p[0], p[2], p[3]) +
      p[2].height * area(p[0], p[1], p[3]) - p[3].height * area(p[0], p[1], p[2]);
  return determinant.sign();
}

int oracle_in_circle(Point a, Point b, Point c, Point d) {
  return oracle_in_circle({lift(a), lift(b), lift(c), lift(d)});
}

/// in_circle of points that really are raised, each by its own tiny height: 2^-1000 for the
/// largest, 2^-2000 for the next and so on.
int oracle_in_circle_perturbed(const std::array<Point, 4>& points) {
  std::array<Lifted, 4> lifted;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto rank = 1 + std::ranges::count_if(points, [&](Point p) { return p > points[i]; });
    lifted[i] = lift(points[i]);
    lifted[i].height += Rational(1, Integer(1) << static_cast<unsigned>(1000 * rank));
  }
  return oracle_in_circle(lifted);
}

/// To nearest, even: by comparing the distances to the two neighbours.
double round_to_double(const Rational& value) {
  double best = value.convert_to<double>();
  const double infinite = std::numeric_limits<double>::infinity();
  const auto error = [&](double d) { return Rational(abs(Rational(d) - value)); };
  for (const double next : {std::nextafter(best, infinite), std::nextafter(best, -infinite)}) {
    const bool even = (std::bit_cast<std::uint64_t>(next) & 1) == 0;
    if (error(next) < error(best) || (error(next) == error(best) && even)) best = next;
  }
  return best;
}

Point oracle_intersection(Point a, Point b, Point c, Point d) {
  const Rational to_a = area(lift(c), lift(d), lift(a));
  const Rational to_b = area(lift(c), lift(d), lift(b));
  const Rational ratio = to_a / (to_a - to_b);
  const auto at = [&](double from, double to) {
    return round_to_double(Rational(from) + ratio * (Rational(to) - Rational(from)));
  };
  return {at(a.x, b.x), at(a.y, b.y)};
}

// --- Nasty inputs ---

double uniform(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

/// A few units in the last place up or down, or none.
double nudged(Random& random, double value) {
  const auto steps = static_cast<int>(random() % 5) - 2;
  const double to = std::copysign(std::numeric_limits<double>::infinity(), steps);
  for (int i = 0; i < std::abs(steps); ++i) value = std::nextafter(value, to);
  return value;
}

struct Generator {
  std::string name;
  std::function<std::array<Point, 4>(Random&)> make;
};

template <class MakePoint>
Generator independent(std::string name, MakePoint make_point) {
  return {std::move(name), [make_point](Random& random) {
            std::array<Point, 4> points;
            for (Point& p : points) p = make_point(random);
            return points;
          }};
}

std::array<Point, 4> nearly_collinear(Random& random, double scale, double offset) {
  const Point a{offset + uniform(random, 0, scale), offset + uniform(random, 0, scale)};
  const Point b{offset + uniform(random, 0, scale), offset + uniform(random, 0, scale)};
  const auto between = [&] {
    const double t = uniform(random, -1, 2);
    return Point{nudged(random, a.x + t * (b.x - a.x)), nudged(random, a.y + t * (b.y - a.y))};
  };
  return {a, between(), b, between()};
}

std::array<Point, 4> nearly_cocircular(Random& random, double radius, double offset) {
  std::array<Point, 4> points;
  const Point centre{offset + uniform(random, 0, radius), offset + uniform(random, 0, radius)};
  for (Point& p : points) {
    const double angle = uniform(random, 0, 6.2831853);
    p = {nudged(random, centre.x + radius * std::cos(angle)),
         nudged(random, centre.y + radius * std::sin(angle))};
  }
  return points;
}

Point grid_point(Random& random, unsigned size, double unit, double offset) {
  return {offset + unit * static_cast<double>(random() % size),
          offset + unit * static_cast<double>(random() % size)};
}

double log_uniform(Random& random) {
  const double magnitude = std::pow(10.0, uniform(random, -50, 50));
  return random() % 2 == 0 ? magnitude : -magnitude;
}

/// On one circle exactly, although no difference of coordinates is a double.
std::array<Point, 4> rectangle(Random& random) {
  const Point low{log_uniform(random), log_uniform(random)};
  const Point high{log_uniform(random), log_uniform(random)};
  return {low, {high.x, low.y}, high, {low.x, high.y}};
}

std::vector<Generator> generators() {
  return {
      independent("grid", [](Random& r) { return grid_point(r, 6, 1, 0); }),
      independent("grid of 1e-5 far out", [](Random& r) { return grid_point(r, 6, 1e-5, 5e6); }),
      independent("half pixels", [](Random& r) { return grid_point(r, 1000, 0.5, -200); }),
      independent("tenths", [](Random& r) { return grid_point(r, 5, 0.1, 0.3); }),
      independent("uniform",
                  [](Random& r) {
                    return Point{uniform(r, 0, 1), uniform(r, 0, 1)};
                  }),
      independent("log-uniform",
                  [](Random& r) {
                    return Point{log_uniform(r), log_uniform(r)};
                  }),
      {"rectangle", rectangle},
      {"nearly collinear", [](Random& r) { return nearly_collinear(r, 100, 0); }},
      {"nearly collinear, small", [](Random& r) { return nearly_collinear(r, 1e-5, 0); }},
      {"nearly collinear, far out", [](Random& r) { return nearly_collinear(r, 1e-5, 5e6); }},
      {"nearly cocircular", [](Random& r) { return nearly_cocircular(r, 100, 0); }},
      {"nearly cocircular, small", [](Random& r) { return nearly_cocircular(r, 1e-5, 0); }},
      {"nearly cocircular, far out", [](Random& r) { return nearly_cocircular(r, 1e-3, 5e6); }},
  };
}

/// Calls property(points) for many points of every generator.
template <class Property>
void for_nasty_points(int count, Property property) {
  for (const Generator& generator : generators()) {
    constexpr std::uint64_t seed = 20240607;
    SCOPED_TRACE(generator.name + ", seed " + std::to_string(seed));
    Random random(seed);
    for (int i = 0; i < count && !::testing::Test::HasFailure(); ++i) {
      const std::array<Point, 4> points = generator.make(random);
      SCOPED_TRACE(::testing::Message() << "round " << i << ": " << std::hexfloat << points[0]
                                        << points[1] << points[2] << points[3]);
      property(points[0], points[1], points[2], points[3]);
    }
  }
}

bool all_different(Point a, Point b, Point c, Point d) {
  return a != b && a != c && a != d && b != c && b != d && c != d;
}

/// What the corresponding generators are for: the oracle must see zeros and both signs.
class Balance {
 public:
  void count(int sign) { ++counts_[static_cast<std::size_t>(sign + 1)]; }
  ~Balance() {
    for (const int n : counts_) EXPECT_GT(n, 100);
  }

 private:
  std::array<int, 3> counts_{};
};

// --- Expansions ---

template <std::size_t N>
Rational value(const Expansion<N>& e) {
  Rational sum = 0;
  for (std::size_t i = 0; i < e.size(); ++i) sum += Rational(e[i]);
  return sum;
}

TEST(Expansion, ComputesExactly) {
  Random random(7);
  for (int i = 0; i < 2000; ++i) {
    const std::array<double, 4> p{log_uniform(random), uniform(random, -1, 1), nudged(random, 1),
                                  log_uniform(random)};
    const auto e = Expansion<2>(two_product(p[0], p[1]));
    const auto f = exact_diff(p[2], p[3]);
    const Rational exact_e = Rational(p[0]) * Rational(p[1]);
    const Rational exact_f = Rational(p[2]) - Rational(p[3]);
    EXPECT_EQ(value(e), exact_e);
    EXPECT_EQ(value(f), exact_f);
    EXPECT_EQ(value(e + f), exact_e + exact_f);
    EXPECT_EQ(value(e - f), exact_e - exact_f);
    EXPECT_EQ(value(e * f), exact_e * exact_f);
    EXPECT_EQ(value(e * p[3]), exact_e * Rational(p[3]));
    EXPECT_EQ(value(e * f * f - f * e * e), exact_e * exact_f * (exact_f - exact_e));
    EXPECT_EQ((e * f - f * e).size(), 0u);
    EXPECT_EQ((e * f - e * p[2]).sign(), -Rational(exact_e * Rational(p[3])).sign());
  }
}

TEST(Expansion, EstimatesToTheLastPlaces) {
  Random random(8);
  for (int i = 0; i < 2000; ++i) {
    const auto e = exact_diff(log_uniform(random), uniform(random, -1, 1));
    const auto f = e * e - exact_diff(nudged(random, 1), uniform(random, 0, 1));
    if (f.sign() == 0) continue;
    const Rational error = abs(Rational(f.estimate()) - value(f));
    EXPECT_LE(error, abs(value(f)) * Rational(0x1p-52));
  }
}

// --- Predicates ---

TEST(Orient, HasTheSignOfTheExactDeterminant) {
  Balance balance;
  for_nasty_points(2000, [&](Point a, Point b, Point c, Point) {
    const int expected = oracle_orient(a, b, c);
    balance.count(expected);
    EXPECT_EQ(orient(a, b, c), expected);
    EXPECT_EQ(detail::orient_exact(a, b, c), expected);
  });
}

TEST(Orient, TurnsWithThePermutation) {
  for_nasty_points(2000, [](Point a, Point b, Point c, Point) {
    EXPECT_EQ(orient(b, c, a), orient(a, b, c));
    EXPECT_EQ(orient(c, a, b), orient(a, b, c));
    EXPECT_EQ(orient(b, a, c), -orient(a, b, c));
    EXPECT_EQ(orient(a, b, a), 0);
    EXPECT_EQ(orient(a, a, b), 0);
  });
}

TEST(Orient, SeesTheSmallestStep) {
  const Point a{0.5, 0.5};
  const Point b{12, 12};
  const Point c{24, 24};
  EXPECT_EQ(orient(a, b, c), 0);
  EXPECT_EQ(orient(a, b, {24, std::nextafter(24, 25)}), 1);
  EXPECT_EQ(orient({0.5, std::nextafter(0.5, 1)}, b, c), 1);
  EXPECT_EQ(orient({0.5, std::nextafter(0.5, 0)}, b, c), -1);
}

TEST(InCircle, IsPositiveInside) {
  EXPECT_EQ(in_circle({0, 0}, {2, 0}, {0, 2}, {1, 1}), 1);
  EXPECT_EQ(in_circle({0, 0}, {2, 0}, {0, 2}, {2, 2}), 0);
  EXPECT_EQ(in_circle({0, 0}, {2, 0}, {0, 2}, {3, 3}), -1);
}

TEST(InCircle, HasTheSignOfTheExactDeterminant) {
  Balance balance;
  for_nasty_points(2000, [&](Point a, Point b, Point c, Point d) {
    const int expected = oracle_in_circle(a, b, c, d);
    balance.count(expected);
    EXPECT_EQ(in_circle(a, b, c, d), expected);
    EXPECT_EQ(detail::in_circle_exact(a, b, c, d), expected);
  });
}

/// For each predicate of four points with the parity laws.
template <class Predicate>
void expect_parity_laws(Predicate predicate) {
  for_nasty_points(500, [&](Point a, Point b, Point c, Point d) {
    const int sign = predicate(a, b, c, d);
    EXPECT_EQ(predicate(b, c, a, d), sign);
    EXPECT_EQ(predicate(b, a, d, c), sign);
    EXPECT_EQ(predicate(d, c, b, a), sign);
    EXPECT_EQ(predicate(b, a, c, d), -sign);
    EXPECT_EQ(predicate(a, b, d, c), -sign);
    EXPECT_EQ(predicate(b, c, d, a), -sign);
    EXPECT_EQ(predicate(d, b, c, a), -sign);
    EXPECT_EQ(predicate(a, b, c, a), 0);
    EXPECT_EQ(predicate(a, b, b, d), 0);
  });
}

TEST(InCircle, TurnsWithThePermutation) { expect_parity_laws(in_circle); }

TEST(InCirclePerturbed, TurnsWithThePermutation) { expect_parity_laws(in_circle_perturbed); }

TEST(InCirclePerturbed, AgreesWithInCircleWhereThatDecides) {
  for_nasty_points(1000, [](Point a, Point b, Point c, Point d) {
    const int sign = in_circle(a, b, c, d);
    if (sign != 0) {
      EXPECT_EQ(in_circle_perturbed(a, b, c, d), sign);
    }
  });
}

TEST(InCirclePerturbed, IsInCircleOfRaisedPoints) {
  for_nasty_points(300, [](Point a, Point b, Point c, Point d) {
    if (!all_different(a, b, c, d)) return;
    EXPECT_EQ(in_circle_perturbed(a, b, c, d), oracle_in_circle_perturbed({a, b, c, d}));
  });
}

TEST(InCirclePerturbed, AlwaysDecidesForATriangleAndAnotherPoint) {
  for_nasty_points(1000, [](Point a, Point b, Point c, Point d) {
    if (!all_different(a, b, c, d) || orient(a, b, c) == 0) return;
    EXPECT_NE(in_circle_perturbed(a, b, c, d), 0);
  });
}

TEST(Crosses, IsTrueForProperCrossingsOnly) {
  EXPECT_TRUE(crosses({0, 0}, {2, 2}, {0, 2}, {2, 0}));
  EXPECT_TRUE(crosses({0, 0}, {2, 2}, {2, 0}, {0, 2}));
  EXPECT_FALSE(crosses({0, 0}, {2, 2}, {0, 2}, {1, 1}));  // ends on it
  EXPECT_FALSE(crosses({0, 0}, {2, 2}, {0, 2}, {0, 0}));  // shares an end
  EXPECT_FALSE(crosses({0, 0}, {2, 2}, {1, 1}, {3, 3}));  // overlaps
  EXPECT_FALSE(crosses({0, 0}, {2, 2}, {4, 0}, {3, 1}));  // beside it
}

TEST(Crosses, HasTheExactAnswer) {
  for_nasty_points(1000, [](Point a, Point b, Point c, Point d) {
    const bool expected = oracle_orient(a, b, c) * oracle_orient(a, b, d) < 0 &&
                          oracle_orient(c, d, a) * oracle_orient(c, d, b) < 0;
    EXPECT_EQ(crosses(a, b, c, d), expected);
    EXPECT_EQ(crosses(d, c, a, b), expected);
  });
}

// --- Construction ---

bool are_parallel(Point a, Point b, Point c, Point d) {
  return area(lift(c), lift(d), lift(a)) == area(lift(c), lift(d), lift(b));
}

TEST(Intersection, IsTheExactPointRoundedToNearestEven) {
  for_nasty_points(300, [](Point a, Point b, Point c, Point d) {
    if (are_parallel(a, b, c, d)) return;
    EXPECT_EQ(intersection(a, b, c, d), oracle_intersection(a, b, c, d));
  });
}

TEST(Intersection, DoesNotDependOnTheOrderOfArguments) {
  for_nasty_points(300, [](Point a, Point b, Point c, Point d) {
    if (are_parallel(a, b, c, d)) return;
    const Point place = intersection(a, b, c, d);
    EXPECT_EQ(intersection(b, a, c, d), place);
    EXPECT_EQ(intersection(a, b, d, c), place);
    EXPECT_EQ(intersection(c, d, a, b), place);
    EXPECT_EQ(intersection(d, c, b, a), place);
  });
}

TEST(Intersection, RoundsTiesToEven) {
  // The x of the crossing is half way between 1 and its neighbours; the lines are exact.
  const double step = 0x1p-52;
  const Point low{1, -1};
  EXPECT_EQ(intersection(low, {1 + step, 1}, {0, 0}, {2, 0}), (Point{1, 0}));
  EXPECT_EQ(intersection({1 + step, -1}, {1 + 2 * step, 1}, {0, 0}, {2, 0}),
            (Point{1 + 2 * step, 0}));
}

TEST(Intersection, OfAxesIsPositiveZero) {
  const Point origin = intersection({-1, 0}, {1, 0}, {0, 1}, {0, -1});
  EXPECT_EQ(origin, (Point{0, 0}));
  EXPECT_FALSE(std::signbit(origin.x) || std::signbit(origin.y));
}

// Points beside an edge at all distances, a thousand last places and less to far away.
TEST(Rounding, IsRuledOutInShortOnlyWhereTheWholeTestDoesSo) {
  std::mt19937_64 random(20261128);
  std::uniform_real_distribution<double> somewhere(-3, 3);
  std::uniform_real_distribution<double> exponent(-16, 0);
  int clear = 0, far = 0;
  constexpr int tries = 20'000;
  for (int i = 0; i < tries; ++i) {
    const Point a{somewhere(random), somewhere(random)};
    const Point b{somewhere(random), somewhere(random)};
    const double along = somewhere(random);
    const double aside = std::pow(10, exponent(random));
    const Point p{a.x + along * (b.x - a.x) - aside * (b.y - a.y),
                  a.y + along * (b.y - a.y) + aside * (b.x - a.x)};
    const double near = crowded_rounding * std::max(std::abs(p.x), std::abs(p.y));
    if (is_clear_of_crowds(detail::Sight(p, a), detail::Sight(p, b), near)) {
      ++clear;
      ASSERT_FALSE(is_crowding(a, b, p)) << a << b << p;
      ASSERT_FALSE(are_hardly_apart(p, a, crowded_rounding)) << a << p;
      ASSERT_FALSE(are_hardly_apart(p, b, crowded_rounding)) << b << p;
    }
    if (Strip(a, b, 18).is_far_from(p)) {
      ++far;
      ASSERT_TRUE(is_clearly_beside(a, b, p, 3)) << a << b << p;
    }
  }
  EXPECT_GT(clear, tries / 2);
  EXPECT_LT(clear, tries * 9 / 10);
  EXPECT_GT(far, tries / 20);
}

}  // namespace
}  // namespace loft::cdt
