// SPDX-License-Identifier: MIT
#include "cdt/locator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "cdt/rounding.h"

namespace loft::cdt {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// As a triangulation has them: the first at infinity.
std::vector<Point> random_points(std::size_t n, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto coordinate = [&] { return static_cast<double>(random() % 100000) / 1000; };
  std::vector<Point> points{{infinity, infinity}};
  while (points.size() <= n) {
    const double x = coordinate();
    points.push_back({x, coordinate()});
  }
  return points;
}

TEST(Locator, KnowsNothingAtFirstAndAfterClear) {
  Locator locator;
  EXPECT_TRUE(locator.near({1, 2}).is_none());
  locator.add(VertexId(1), {1, 2});
  EXPECT_TRUE(locator.near({1, 2}).is_none());
  const auto points = random_points(100, 1);
  locator.lay_out(points, 100);
  EXPECT_FALSE(locator.near({1, 2}).is_none());
  locator.clear();
  EXPECT_TRUE(locator.near({1, 2}).is_none());
}

TEST(Locator, SuggestsWhatIsNear) {
  const auto points = random_points(10000, 2);
  Locator locator;
  locator.lay_out(points, 10000);
  double sum = 0;
  for (const Point p : random_points(1000, 3)) {
    if (!std::isfinite(p.x)) continue;
    const VertexId v = locator.near(p);
    ASSERT_TRUE(v.index() > 0 && v.index() < points.size());
    sum += distance(p, points[v.index()]);
  }
  EXPECT_LT(sum / 1000, 3);  // the points are about one apart
}

/// Cells are not longer than wide, however long and thin the box of all is.
TEST(Locator, SuggestsWhatIsNearInAColumnAndInARow) {
  for (const bool is_row : {false, true}) {
    auto points = random_points(10000, 11);
    auto places = random_points(1000, 12);
    for (auto* some : {&points, &places})
      for (Point& p : *some) p = is_row ? Point{p.x * 10000, p.y} : Point{p.x, p.y * 10000};
    Locator locator;
    locator.lay_out(points, 10000);
    double sum = 0;
    for (std::size_t i = 1; i < places.size(); ++i)
      sum += distance(places[i], points[locator.near(places[i]).index()]);
    EXPECT_LT(sum / 1000, 300);  // the points are about 100 apart
  }
}

TEST(Locator, KnowsWhatWasAddedLast) {
  const auto points = random_points(500, 4);
  Locator locator;
  locator.lay_out(points, 500);
  for (std::uint32_t v = 501; v < 700; ++v) {
    const Point p{0.5 * (v - 500), 50};
    locator.add(VertexId(v), p);
    EXPECT_EQ(locator.near(p), VertexId(v));
  }
}

TEST(Locator, ForgetsWhatIsReplaced) {
  const auto points = random_points(300, 5);
  Locator locator;
  locator.lay_out(points, 300);
  const auto places = random_points(1000, 6);
  for (std::uint32_t v = 1; v <= 300; ++v) {
    locator.replace(VertexId(v), points[v], v % 2 == 0 ? VertexId::none() : VertexId(301));
    for (std::size_t i = 1; i < places.size(); i += 50)
      ASSERT_NE(locator.near(places[i]), VertexId(v));
    ASSERT_NE(locator.near(points[v]), VertexId(v));
  }
}

TEST(Locator, FollowsWhatMoves) {
  std::vector<Point> points = random_points(300, 7);
  Locator locator;
  locator.lay_out(points, 300);
  const auto goals = random_points(300, 8);
  for (std::uint32_t v = 1; v <= 300; ++v) {
    locator.add(VertexId(v), points[v]);
    locator.move(VertexId(v), points[v], goals[v], VertexId::none());
    ASSERT_EQ(locator.near(goals[v]), VertexId(v));
    if (distance(points[v], goals[v]) > 50) {
      ASSERT_NE(locator.near(points[v]), VertexId(v));
    }
  }
}

TEST(Locator, MindsNeitherUnusedPointsNorPlacesAnywhere) {
  auto points = random_points(200, 9);
  for (std::size_t i = 1; i < points.size(); i += 2) points[i] = points[0];
  Locator locator;
  locator.lay_out(points, 100);
  constexpr double far[] = {-1e300, -1e75, -1, 0, 0.5, 50, 101, 1e75, 1e300};
  for (const double x : far) {
    for (const double y : far) {
      const VertexId v = locator.near({x, y});
      EXPECT_TRUE(v.index() > 0 && v.index() < points.size() && v.index() % 2 == 0);
    }
  }
  for (const std::vector<Point>& few :
       {std::vector<Point>{points[0], {3, 3}}, {points[0], {3, 3}, {4, 3}, {9, 3}}}) {
    locator.lay_out(few, few.size() - 1);  // all in one place or line
    EXPECT_LT(locator.near({3, 3}).index(), few.size());
  }
}

TEST(Locator, IsOutgrownByNumbersAndByPlaces) {
  const auto points = random_points(1000, 10);
  Locator locator;
  EXPECT_FALSE(locator.is_outgrown(63, {1, 1}));
  EXPECT_TRUE(locator.is_outgrown(64, {1, 1}));
  locator.lay_out(points, 1000);
  EXPECT_FALSE(locator.is_outgrown(2000, {50, 50}));
  EXPECT_TRUE(locator.is_outgrown(2001, {50, 50}));
  EXPECT_FALSE(locator.is_outgrown(1250, {500, 50}));
  EXPECT_TRUE(locator.is_outgrown(1251, {500, 50}));
}

}  // namespace
}  // namespace loft::cdt
