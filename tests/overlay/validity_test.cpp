// SPDX-License-Identifier: MIT
#include "overlay/validity.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "cdt/predicates.h"
#include "tests/cases.h"

namespace loft::overlay {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using ::testing::UnorderedElementsAre;
using Problem = Invalidity::Kind;
using cdt::Point;

Ring block(double x, double y, double width, double height) {
  return {{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}};
}
Ring reversed(Ring ring) {
  std::ranges::reverse(ring);
  return ring;
}
Ring hole(double x, double y, double width, double height) {
  return reversed(block(x, y, width, height));
}

MultiPolygon one(Ring outer, std::vector<Ring> holes = {}) {
  return {{std::move(outer), std::move(holes)}};
}

std::vector<Problem> kinds(const MultiPolygon& polygons) {
  std::vector<Problem> result;
  for (const Invalidity& problem : validity_problems(polygons)) result.push_back(problem.kind);
  return result;
}

Invalidity alone(Problem kind, Point place) { return {kind, {0, 0}, place, std::nullopt}; }
Invalidity with_other(Problem kind, RingOf ring, Point place, RingOf other) {
  return {kind, ring, place, other};
}

void expect_valid(const MultiPolygon& polygons) {
  EXPECT_THAT(validity_problems(polygons), IsEmpty());
  EXPECT_TRUE(is_valid(polygons));
}
void expect_only(const MultiPolygon& polygons, const Invalidity& wanted) {
  EXPECT_THAT(validity_problems(polygons), ElementsAre(wanted));
  EXPECT_FALSE(is_valid(polygons));
}

// What is valid.

TEST(Valid, NothingAndSimplePolygons) {
  expect_valid({});
  expect_valid(one({{0, 0}, {1, 0}, {0, 1}}));
  expect_valid(one(block(0, 0, 9, 9), {hole(1, 1, 2, 2), hole(4, 4, 2, 2)}));
}

TEST(Valid, PointsOnStraightPiecesAreNoProblem) {
  expect_valid(one({{0, 0}, {1, 0}, {2, 0}, {2, 2}, {1, 2}, {0, 2}, {0, 1}}));
}

TEST(Valid, AHoleMayTouchTheOuterRingInAPoint) {
  expect_valid(one(block(0, 0, 4, 4), {{{0, 2}, {2, 3}, {2, 1}}}));  // on an edge
  expect_valid(one(block(0, 0, 4, 4), {{{0, 0}, {1, 2}, {2, 1}}}));  // in a corner
  expect_valid(one({{0, 0}, {4, 0}, {2, 2}, {4, 4}, {0, 4}},         // a corner in its edge
                   {{{2, 1}, {1, 2}, {2, 3}}}));
}

TEST(Valid, ManyHolesMayTouchInOnePoint) {
  expect_valid(one(block(-4, -4, 8, 8), {{{0, 0}, {1, 2}, {2, 1}},
                                         {{0, 0}, {2, -1}, {1, -2}},
                                         {{0, 0}, {-1, -2}, {-2, -1}},
                                         {{0, 0}, {-2, 1}, {-1, 2}}}));
}

TEST(Valid, AChainOfHolesThatEndsInside) {
  expect_valid(one(block(0, 0, 8, 4),
                   {{{0, 2}, {2, 3}, {2, 1}}, {{2, 3}, {4, 3}, {4, 2}}, {{4, 3}, {6, 3}, {6, 2}}}));
}

TEST(Valid, PolygonsMayTouchInPoints) {
  expect_valid({{block(0, 0, 2, 2), {}}, {block(2, 2, 2, 2), {}}});
  expect_valid({{block(0, 0, 2, 2), {}}, {{{2, 1}, {3, 0}, {3, 2}}, {}}});
  // Two of them, in two points: what is between is outside of both.
  expect_valid({{{{0, 0}, {4, 0}, {2, 1}}, {}}, {{{0, 0}, {2, 2}, {4, 0}, {2, 4}}, {}}});
}

TEST(Valid, APolygonInTheHoleOfAnother) {
  const Polygon frame{block(0, 0, 9, 9), {hole(1, 1, 7, 7)}};
  expect_valid({frame, {block(2, 2, 5, 5), {hole(3, 3, 3, 3)}}, {block(4, 4, 1, 1), {}}});
  // All of its corners on the hole.
  expect_valid({frame, {{{4, 1}, {8, 4}, {4, 8}, {1, 4}}, {}}});
}

TEST(Valid, HoweverNear) {
  const double next = std::nextafter(1.0, 2.0);
  expect_valid({{block(0, 0, 1, 1), {}}, {{{next, 0}, {2, 0}, {2, 1}, {next, 1}}, {}}});
  expect_only({{block(0, 0, 1, 1), {}}, {{{1, 0.25}, {2, 0}, {2, 1}, {1, 0.75}}, {}}},
              with_other(Problem::runs_along_other, {0, 0}, {1, 0.25}, {1, 0}));
  // 0.1 + 0.2 is above 0.3, so this corner is inside the edge from (0, 0) or beyond it.
  const Ring slanted{{0, 0}, {10, 3}, {10, 4}};
  const double y = 0.1 * 3;  // 0.30000000000000004
  expect_valid({{slanted, {}}, {{{1, std::nextafter(0.3, 0)}, {1, -1}, {2, -1}}, {}}});
  EXPECT_THAT(kinds({{slanted, {}}, {{{1, y}, {1, -1}, {2, -1}}, {}}}),
              ElementsAre(Problem::crosses_other, Problem::crosses_other));
}

// What is wrong with one ring.

TEST(Invalid, UnusablePoints) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto problems = validity_problems(one({{0, 0}, {1, nan}, {1e80, 1}, {0, 1}}));
  ASSERT_THAT(problems, SizeIs(2));
  for (const Invalidity& problem : problems) EXPECT_EQ(problem.kind, Problem::unusable_point);
}

TEST(Invalid, TooFewPoints) {
  expect_only(one({}), alone(Problem::too_few_points, {0, 0}));
  expect_only(one({{1, 2}}), alone(Problem::too_few_points, {1, 2}));
  expect_only(one({{1, 2}, {3, 4}}), alone(Problem::too_few_points, {1, 2}));
  EXPECT_THAT(kinds(one({{1, 2}, {3, 4}, {3, 4}})),
              ElementsAre(Problem::too_few_points, Problem::repeated_point));
  EXPECT_THAT(kinds(one({{1, 2}, {3, 4}, {1, 2}, {3, 4}})), ElementsAre(Problem::too_few_points));
  EXPECT_THAT(kinds(one(block(0, 0, 3, 3), {{{1, 1}, {2, 2}}})),
              ElementsAre(Problem::too_few_points));
}

TEST(Invalid, RepeatedPoints) {
  expect_only(one({{0, 0}, {1, 0}, {1, 0}, {0, 1}}), alone(Problem::repeated_point, {1, 0}));
  expect_only(one({{0, 0}, {1, 0}, {0, 1}, {0, 0}}), alone(Problem::repeated_point, {0, 0}));
}

TEST(Invalid, RingsThatCrossThemselves) {
  expect_only(one({{0, 0}, {2, 2}, {2, 0}, {0, 2}}), alone(Problem::crosses_itself, {1, 1}));
  // In a corner of both ways, and in a corner of one.
  expect_only(one({{0, 0}, {1, 1}, {2, 2}, {2, 0}, {1, 1}, {0, 2}}),
              alone(Problem::crosses_itself, {1, 1}));
  expect_only(one({{0, 0}, {1, 1}, {2, 2}, {2, 0}, {0, 2}}),
              alone(Problem::crosses_itself, {1, 1}));
  EXPECT_THAT(kinds(one({{0, 5}, {10, 5}, {2, 0}, {5, 9}, {8, 0}})),  // five of a pentagram
              ElementsAre(Problem::crosses_itself, Problem::crosses_itself, Problem::crosses_itself,
                          Problem::crosses_itself, Problem::crosses_itself));
}

TEST(Invalid, RingsThatTouchThemselves) {
  // CGAL/cgal#3697, from outside; then from inside; then with a corner on an edge.
  expect_only(one({{2, 1}, {3, 0}, {5, 4}, {2, 1}, {1, 3}, {0, 2}}),
              alone(Problem::touches_itself, {2, 1}));
  expect_only(one({{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}, {1, 2}, {2, 1}}),
              alone(Problem::touches_itself, {0, 0}));
  expect_only(one({{0, 0}, {4, 0}, {4, 4}, {2, 0}, {0, 4}}),
              alone(Problem::touches_itself, {2, 0}));
}

TEST(Invalid, RingsThatRunAlongThemselves) {
  expect_only(one({{0, 0}, {3, 0}, {5, 0}, {3, 0}, {3, 3}, {0, 3}}),
              alone(Problem::runs_along_itself, {3, 0}));
  // A slit.
  EXPECT_THAT(kinds(one({{0, 0}, {4, 0}, {4, 4}, {2, 4}, {2, 2}, {2, 4}, {0, 4}})),
              ElementsAre(Problem::runs_along_itself));
  EXPECT_THAT(kinds(one({{0, 0}, {1, 1}, {3, 3}})),
              ElementsAre(Problem::runs_along_itself, Problem::runs_along_itself));
  // Twice around.
  EXPECT_THAT(kinds(one({{0, 0}, {1, 0}, {0, 1}, {0, 0}, {1, 0}, {0, 1}})),
              ElementsAre(Problem::runs_along_itself, Problem::runs_along_itself,
                          Problem::runs_along_itself));
}

TEST(Invalid, WrongOrientation) {
  expect_only(one(hole(0, 0, 2, 2)), alone(Problem::wrong_orientation, {0, 0}));
  EXPECT_THAT(validity_problems(one(block(0, 0, 9, 9), {block(1, 2, 3, 3)})),
              ElementsAre(Invalidity{Problem::wrong_orientation, {0, 1}, {1, 2}, std::nullopt}));
}

// What is wrong between two rings.

TEST(Invalid, RingsThatCross) {
  EXPECT_THAT(validity_problems({{block(0, 0, 2, 2), {}}, {block(1, 1, 2, 2), {}}}),
              UnorderedElementsAre(with_other(Problem::crosses_other, {0, 0}, {2, 1}, {1, 0}),
                                   with_other(Problem::crosses_other, {0, 0}, {1, 2}, {1, 0})));
  EXPECT_THAT(kinds(one(block(0, 0, 4, 4), {hole(2, 2, 4, 1)})),
              ElementsAre(Problem::crosses_other, Problem::crosses_other));
  EXPECT_THAT(kinds(one(block(0, 0, 9, 9), {hole(1, 1, 3, 3), hole(2, 2, 4, 1)})),
              ElementsAre(Problem::crosses_other, Problem::crosses_other));
}

TEST(Invalid, RingsThatCrossInCorners) {
  const Polygon outline{block(0, 0, 2, 2), {}};
  const auto crossings = [](Point first, Point second) {
    return ElementsAre(with_other(Problem::crosses_other, {0, 0}, first, {1, 0}),
                       with_other(Problem::crosses_other, {0, 0}, second, {1, 0}));
  };
  // An edge through a corner; a corner in a corner; a corner on an edge.
  EXPECT_THAT(validity_problems({outline, {{{3, 1}, {3, 3}, {1, 1}}, {}}}),
              crossings({2, 1}, {2, 2}));
  EXPECT_THAT(validity_problems({outline, {{{3, 1}, {3, 3}, {2, 2}, {1, 1}}, {}}}),
              crossings({2, 1}, {2, 2}));
  EXPECT_THAT(validity_problems({outline, {{{3, 2}, {2, 1.5}, {1, 1}, {3, 0.5}}, {}}}),
              crossings({2, 0.75}, {2, 1.5}));
}

TEST(Invalid, RingsThatRunAlongOneAnother) {
  expect_only({{block(0, 0, 2, 2), {}}, {block(2, 1, 2, 2), {}}},
              with_other(Problem::runs_along_other, {0, 0}, {2, 1}, {1, 0}));
  EXPECT_THAT(kinds(one(block(0, 0, 4, 4), {hole(0, 1, 2, 2)})),
              ElementsAre(Problem::runs_along_other));
  EXPECT_THAT(kinds(one(block(0, 0, 9, 9), {hole(1, 1, 2, 2), hole(3, 1, 2, 2)})),
              ElementsAre(Problem::runs_along_other));
  // The same polygon twice.
  EXPECT_THAT(kinds({{block(0, 0, 2, 2), {}}, {block(0, 0, 2, 2), {}}}),
              ::testing::Each(Problem::runs_along_other));
}

TEST(Invalid, HolesOutside) {
  EXPECT_THAT(validity_problems(one(block(0, 0, 2, 2), {hole(5, 5, 1, 1)})),
              ElementsAre(with_other(Problem::hole_outside, {0, 1}, {5, 6}, {0, 0})));
  // Around the outer ring, and touching it from outside in two points.
  EXPECT_THAT(kinds(one(block(1, 1, 2, 2), {hole(0, 0, 4, 4)})),
              ElementsAre(Problem::hole_outside));
  EXPECT_THAT(kinds(one({{0, 0}, {4, 0}, {2, 1}}, {reversed({{0, 0}, {2, 2}, {4, 0}, {2, 4}})})),
              ElementsAre(Problem::hole_outside));
}

TEST(Invalid, HolesInHoles) {
  EXPECT_THAT(validity_problems(one(block(0, 0, 9, 9), {hole(1, 1, 7, 7), hole(2, 2, 2, 2)})),
              ElementsAre(with_other(Problem::hole_in_hole, {0, 2}, {2, 4}, {0, 1})));
  // All of its corners on the other.
  EXPECT_THAT(kinds(one(block(-9, -9, 18, 18),
                        {hole(-2, -2, 4, 4), reversed({{2, 0}, {0, 2}, {-2, 0}, {0, -2}})})),
              ElementsAre(Problem::hole_in_hole));
}

TEST(Invalid, PolygonsInPolygons) {
  expect_only({{block(0, 0, 9, 9), {}}, {block(1, 1, 2, 2), {}}},
              with_other(Problem::polygon_in_polygon, {1, 0}, {1, 1}, {0, 0}));
  // Around a hole of the other.
  EXPECT_THAT(kinds({{block(0, 0, 9, 9), {hole(3, 3, 2, 2)}}, {block(2, 2, 4, 4), {}}}),
              ElementsAre(Problem::polygon_in_polygon));
  EXPECT_THAT(kinds({{block(0, 0, 4, 4), {}}, {{{4, 2}, {2, 4}, {0, 2}, {2, 0}}, {}}}),
              ElementsAre(Problem::polygon_in_polygon));
}

// What is wrong with a polygon whose rings are as they should be.

TEST(Invalid, AHoleThatCutsThePolygon) {
  EXPECT_THAT(validity_problems(one(block(0, 0, 4, 4), {{{0, 2}, {2, 3}, {4, 2}, {2, 1}}})),
              ElementsAre(with_other(Problem::inside_cut, {0, 0}, {4, 2}, {0, 1})));
  // Three corners on the outer ring.
  EXPECT_THAT(kinds(one(block(0, 0, 4, 4), {{{0, 0}, {2, 4}, {4, 2}}})),
              ElementsAre(Problem::inside_cut, Problem::inside_cut));
}

TEST(Invalid, HolesThatCutThePolygonTogether) {
  EXPECT_THAT(kinds(one(block(0, 0, 6, 6), {{{0, 3}, {3, 4}, {3, 2}}, {{3, 2}, {4, 4}, {6, 3}}})),
              ElementsAre(Problem::inside_cut));
  // Three in a circle around a piece of the inside.
  EXPECT_THAT(kinds(one(block(-9, -9, 18, 18), {{{0, 0}, {2, -1}, {4, 0}, {2, -3}},
                                                {{4, 0}, {3, 2}, {2, 4}, {5, 3}},
                                                {{2, 4}, {1, 2}, {0, 0}, {-1, 3}}})),
              ElementsAre(Problem::inside_cut));
  // Two that touch in two points.
  EXPECT_THAT(kinds(one(block(-9, -9, 18, 18), {reversed({{0, 0}, {4, 0}, {2, 1}}),
                                                reversed({{0, 0}, {2, 2}, {4, 0}, {2, 4}})})),
              ElementsAre(Problem::inside_cut));
}

TEST(Invalid, AllOfItIsTold) {
  const MultiPolygon polygons{
      {block(0, 0, 9, 9),
       {hole(1, 1, 3, 3), hole(2, 2, 1, 1), hole(20, 0, 1, 1), block(5, 5, 1, 1)}},
      {{{30, 0}, {32, 2}, {32, 0}, {30, 2}}, {}},
      {block(7, 7, 1, 1), {{{7, 7}, {7, 7}}}}};
  EXPECT_THAT(kinds(polygons), ElementsAre(Problem::hole_in_hole, Problem::hole_outside,
                                           Problem::wrong_orientation, Problem::crosses_itself,
                                           Problem::polygon_in_polygon, Problem::too_few_points,
                                           Problem::repeated_point, Problem::repeated_point));
}

TEST(Invalid, ProblemsAreSaidInWords) {
  EXPECT_EQ(::testing::PrintToString(with_other(Problem::hole_outside, {3, 1}, {5, 6}, {3, 0})),
            "polygon 3 ring 1 is a hole outside of polygon 3 ring 0 at (5, 6)");
  EXPECT_EQ(::testing::PrintToString(alone(Problem::crosses_itself, {1, 1})),
            "polygon 0 ring 0 crosses itself at (1, 1)");
}

// Against what is slow and simple.

/// Whether two edges of a ring that do not follow one another meet, or two that do more than in
/// their corner.
bool is_simple_by_hand(const Ring& ring) {
  const std::size_t n = ring.size();
  const auto corner = [&](std::size_t i) { return ring[i % n]; };
  const auto is_on = [](Point p, Point a, Point b) {
    return cdt::orient(a, b, p) == 0 && std::min(a, b) <= p && p <= std::max(a, b);
  };
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t k = i + 1; k < n; ++k) {
      const Point a = corner(i), b = corner(i + 1), c = corner(k), d = corner(k + 1);
      if (a == b || c == d || cdt::crosses(a, b, c, d)) return false;
      if (k != i + 1 && (is_on(c, a, b) || is_on(b, c, d))) return false;
      if (k + 1 != i + n && (is_on(d, a, b) || is_on(a, c, d))) return false;
    }
  return true;
}

TEST(Validity, RandomRingsAreSimpleAsByHand) {
  std::size_t valid = 0;
  for (std::uint64_t seed = 0; seed < cases(20'000); ++seed) {
    std::mt19937_64 random(seed);
    Ring ring;
    for (std::size_t n = 3 + random() % 4; n > 0; --n)
      ring.push_back({static_cast<double>(random() % 6), static_cast<double>(random() % 6)});
    const bool is_clockwise = area(ring).sign() < 0;
    if (is_clockwise) ring = reversed(ring);
    ASSERT_EQ(is_valid(one(ring)), is_simple_by_hand(ring)) << "seed " << seed;
    valid += is_valid(one(ring)) ? 1U : 0U;
  }
  EXPECT_GT(valid, cases(20'000) / 10);
}

/// Discs whose neighbours touch in points, with holes: so many points.
MultiPolygon grid_of_rings(int columns, int corners) {
  MultiPolygon result;
  const auto diamond = [](double x, double y, double size, int count) {
    Ring ring;
    for (int i = 0; i < count; ++i) {
      const double turn = 2 * std::numbers::pi * i / count;
      ring.push_back({x + size * std::cos(turn), y + size * std::sin(turn)});
    }
    return ring;
  };
  for (int x = 0; x < columns; ++x)
    for (int y = 0; y < columns; ++y)
      result.push_back({diamond(2.5 * x, 2.5 * y, 1, corners),
                        {reversed(diamond(2.5 * x, 2.5 * y, 0.5, corners))}});
  return result;
}

TEST(Validity, ManyRings) {
  MultiPolygon many = grid_of_rings(30, 20);
  expect_valid(many);
  std::swap(many[7].holes, many[400].holes);
  EXPECT_THAT(kinds(many), ElementsAre(Problem::hole_outside, Problem::hole_outside));
}

}  // namespace
}  // namespace loft::overlay
