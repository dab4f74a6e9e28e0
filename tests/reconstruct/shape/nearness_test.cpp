// SPDX-License-Identifier: MIT
#include "reconstruct/shape/nearness.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "mesh/vec3.h"
#include "tests/reconstruct/triangles.h"

namespace loft {
namespace {

Corners random_triangle(std::mt19937_64& random, double height) {
  std::uniform_real_distribution<double> flat(-1, 1);
  std::uniform_real_distribution<double> up(-height, height);
  Corners triangle{};
  for (Vec3& corner : triangle) corner = {flat(random), flat(random), up(random)};
  return triangle;
}

double least_distance(const Vec3& p, const std::vector<Corners>& others) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [a, b, c] : others) least = std::min(least, triangles::distance(p, a, b, c));
  return least;
}

/// Over many points of a triangle.
double farthest(const Corners& whole, const std::vector<Corners>& others) {
  constexpr int steps = 24;
  double most = 0;
  for (int i = 0; i <= steps; ++i)
    for (int j = 0; i + j <= steps; ++j) {
      const Vec3 on_edge = along(whole[0], 1.0 * i / steps, minus(whole[1], whole[0]));
      most = std::max(
          most, least_distance(along(on_edge, 1.0 * j / steps, minus(whole[2], whole[0])), others));
    }
  return most;
}

TEST(Nearness, DistanceToATriangleIsThatToItsNearestPoint) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 2000; ++i) {
    const Corners triangle = random_triangle(random, 1);
    const Vec3 p = random_triangle(random, 1)[0];
    EXPECT_NEAR(std::sqrt(squared_distance(p, triangle)), least_distance(p, {triangle}), 1e-9);
  }
}

TEST(Nearness, ASquareInTwoHalvesIsNearTheOtherTwoHalves) {
  const Vec3 a{0, 0, 0}, b{1, 0, 0}, c{1, 1, 0}, d{0, 1, 0};
  const std::vector<Corners> halves{{b, c, d}, {b, d, a}};
  Nearness nearness(0.001);
  for (const Corners& half : {Corners{a, b, c}, Corners{a, c, d}}) {
    EXPECT_TRUE(nearness.all_near(half, halves));
    EXPECT_EQ(nearness.used().size(), 2U);
    EXPECT_FALSE(nearness.all_near(half, std::vector{halves.front()}));
  }
  EXPECT_TRUE(nearness.all_near(halves.front(), halves));
  EXPECT_EQ(nearness.used().size(), 1U);
}

TEST(Nearness, AYesIsRightAndTheUsedAreEnough) {
  std::mt19937_64 random(7);
  int yes = 0;
  for (int i = 0; i < 300; ++i) {
    std::vector<Corners> others;
    for (int k = 0; k < 12; ++k) others.push_back(random_triangle(random, 0.05));
    const Corners whole = random_triangle(random, 0.05);
    const double distance = 0.1;
    Nearness nearness(distance);
    if (!nearness.all_near(whole, others)) continue;
    ++yes;
    std::vector<Corners> used;
    for (const std::uint32_t k : nearness.used()) used.push_back(others[k]);
    EXPECT_LE(farthest(whole, used), distance + 1e-9) << "case " << i;
  }
  EXPECT_GT(yes, 30);
}

TEST(Nearness, ANoIsRightButForAFewInAHundred) {
  std::mt19937_64 random(9);
  int no = 0;
  int wrong = 0;
  for (int i = 0; i < 300; ++i) {
    std::vector<Corners> others;
    for (int k = 0; k < 12; ++k) others.push_back(random_triangle(random, 0.05));
    const Corners whole = random_triangle(random, 0.05);
    if (Nearness(0.1).all_near(whole, others)) continue;
    ++no;
    if (farthest(whole, others) < 0.1 * 0.98) ++wrong;
  }
  EXPECT_GT(no, 30);
  EXPECT_LE(wrong, no / 30);
}

}  // namespace
}  // namespace loft
