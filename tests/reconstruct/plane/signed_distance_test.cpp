// SPDX-License-Identifier: MIT
#include "reconstruct/plane/signed_distance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "cdt/predicates.h"
#include "reconstruct/clean/cleaning.h"
#include "reconstruct/clean/region.h"
#include "reconstruct/plane/nearest.h"
#include "tests/reconstruct/stacks.h"

namespace loft {
namespace {

Region clean_slice(const Slice& slice) {
  std::vector<ContourSource> sources;
  for (std::uint32_t c = 0; c < slice.contours.size(); ++c)
    sources.push_back({slice.contours[c].points, 0, c});
  std::vector<Defect> repairs;
  return clean(sources, slice.z, {}, repairs);
}

/// By every edge: the distance, and the parity of those that a ray from p crosses.
double brute_force(const Region& region, cdt::Point p) {
  double least = std::numeric_limits<double>::infinity();
  bool is_inside = false;
  for (std::size_t i = 0; i < region.loop_count(); ++i) {
    const auto loop = region.loop(i);
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const cdt::Point a = region.points[loop[k]];
      const cdt::Point b = region.points[loop[(k + 1) % loop.size()]];
      least = std::min(least, distance(p, a, b));
      if ((a.y > p.y) != (b.y > p.y) && (cdt::orient(a, b, p) > 0) == (b.y > a.y))
        is_inside = !is_inside;
    }
  }
  return is_inside ? -least : least;
}

TEST(SignedDistance, IsThatOfEveryEdge) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    const Region region =
        clean_slice(seed % 3 == 0 ? stacks::random_mask(0, random, 6, 0.5)
                                  : stacks::random_slice(0, random, seed % 3 == 1));
    const SignedDistance signed_distance(boundary(region));
    ASSERT_EQ(signed_distance.is_empty(), region.is_empty());
    if (region.is_empty()) continue;
    std::uniform_real_distribution<double> anywhere(-1, 8);
    for (int i = 0; i < 200; ++i) {
      const cdt::Point p{anywhere(random), anywhere(random)};
      EXPECT_NEAR(signed_distance.at(p).distance, brute_force(region, p), 1e-12) << p;
    }
  }
}

// Of a thin wall one side is asked for; turned by half a turn, the other one.
TEST(SignedDistance, IsThatToTheSideOfAWallThatIsAskedFor) {
  const SignedDistance wall(boundary(clean_slice({0, {stacks::square(2), stacks::square(1.9)}})));
  EXPECT_NEAR(wall.at({1.91, 0}).distance, -0.01, 1e-12);
  EXPECT_NEAR(wall.at({1.91, 0}, {1, 0}).distance, -0.09, 1e-12);
  EXPECT_NEAR(wall.at({1.91, 0}, {-1, 0}).distance, -0.01, 1e-12);
  EXPECT_NEAR(wall.at({1.8, 0}, {1, 0}).distance, -0.2, 1e-12);
  EXPECT_EQ(wall.at({1.91, 0}, {}).distance, wall.at({1.91, 0}).distance);
}

TEST(SignedDistance, FindsTheNearestCornerAndTheShorterEdgeAtIt) {
  Contour contour;
  contour.points = {{0, 0}, {4, 0}, {4, 3}};
  const SignedDistance triangle(boundary(clean_slice({0, {contour}})));
  const auto found = triangle.corner_near({4.25, 0}, 0.5);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->distance, 0.25);
  EXPECT_EQ(found->edge, 3);
  EXPECT_FALSE(triangle.corner_near({4.25, 0}, 0.125));
  EXPECT_EQ(triangle.corner_near({0, 0}, 0)->edge, 4);
}

TEST(SignedDistance, GrowsOutwards) {
  const SignedDistance square(boundary(clean_slice({0, {stacks::square(1)}})));
  const auto inside = square.at({0.75, 0.1});
  EXPECT_EQ(inside.distance, -0.25);
  EXPECT_DOUBLE_EQ(inside.outward.x, 1);
  EXPECT_NEAR(inside.outward.y, 0, 1e-15);
  const auto outside = square.at({4, 5});
  EXPECT_EQ(outside.distance, 5);
  EXPECT_DOUBLE_EQ(outside.outward.x, 0.6);
  EXPECT_DOUBLE_EQ(outside.outward.y, 0.8);
  const auto upon = square.at({-1, 0.5});
  EXPECT_EQ(upon.distance, 0);
  EXPECT_EQ(upon.outward, (cdt::Point{-1, 0}));
}

TEST(SignedDistance, GrowsTheMeanWayWherePlacesAreEquallyNear) {
  for (const double angle : {0.0, 0.4, 2.0}) {  // rounding is another at each
    SCOPED_TRACE(angle);
    const auto turned = [&](cdt::Point p) {
      return cdt::Point{p.x * std::cos(angle) - p.y * std::sin(angle),
                        p.x * std::sin(angle) + p.y * std::cos(angle)};
    };
    Contour contour = stacks::square(1);
    for (cdt::Point& p : contour.points) p = turned(p);
    const SignedDistance square(boundary(clean_slice({0, {contour}})));
    const auto between = square.at(turned({0.5, 0.5}));
    EXPECT_NEAR(between.distance, -0.5, 1e-12);
    EXPECT_NEAR(between.outward.x, turned({0.5, 0.5}).x, 1e-12);
    EXPECT_NEAR(between.outward.y, turned({0.5, 0.5}).y, 1e-12);
    const auto middle = square.at({0, 0});
    EXPECT_NEAR(std::hypot(middle.outward.x, middle.outward.y), 0, 1e-12);
    EXPECT_NEAR(std::hypot(middle.foot.x, middle.foot.y), 1, 1e-12);
    const auto to_one = square.at(turned({0.5, 0.5}), turned({0.6, -0.8}));
    EXPECT_NEAR(to_one.outward.x, turned({1, 0}).x, 1e-12);
    EXPECT_NEAR(to_one.outward.y, turned({1, 0}).y, 1e-12);
  }
  const SignedDistance round(boundary(clean_slice({0, {stacks::circle(80, 3)}})));
  EXPECT_EQ(round.at({0, 0}).outward, (cdt::Point{0, 0}));
}

// A corner that two loops share: which of its edges is nearest decides on the side.
TEST(SignedDistance, KnowsItsSideAtCornersThatTouch) {
  const SignedDistance touching(
      boundary(clean_slice({0, {stacks::square(1, {-1, -1}), stacks::square(1, {1, 1})}})));
  EXPECT_GT(touching.at({-0.1, 0.1}).distance, 0);
  EXPECT_GT(touching.at({0.1, -0.1}).distance, 0);
  EXPECT_LT(touching.at({0.1, 0.2}).distance, 0);
  EXPECT_LT(touching.at({-0.1, -0.2}).distance, 0);
}

}  // namespace
}  // namespace loft
