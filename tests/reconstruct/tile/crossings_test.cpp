// SPDX-License-Identifier: MIT
#include "reconstruct/tile/crossings.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "mesh/measure.h"
#include "reconstruct/reconstruct.h"
#include "reconstruct/tile/fan_change.h"
#include "tests/reconstruct/solid.h"

namespace loft {
namespace {

using std::numbers::pi;

/// A rectangle about the origin, turned.
Contour bar(double length, double width, double angle) {
  Contour contour;
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  for (const auto& [x, y] :
       {std::pair{-0.5, -0.5}, std::pair{0.5, -0.5}, std::pair{0.5, 0.5}, std::pair{-0.5, 0.5}})
    contour.points.push_back({x * length * c - y * width * s, x * length * s + y * width * c});
  return contour;
}

/// Of a solid, over the distance of its first slice from its last.
double volume_over_height(const std::vector<Slice>& slices) {
  const Surface surface = reconstruct(slices).surface;
  EXPECT_EQ(solids::faults(surface), "");
  const Measures measures = measure(to_mesh(surface));
  EXPECT_EQ(measures.components, 1U);
  EXPECT_EQ(measures.genus, 0);
  return measures.volume / (slices.back().z - slices.front().z);
}

/// The volume of two bars is the same share of the gap whatever that is.
double over_any_gap(const Contour& lower, const Contour& upper) {
  const double expected = volume_over_height({{0, {lower}}, {1, {upper}}});
  for (const double gap : {0.01, 0.1, 0.37, 5.0, 20.0, 100.0}) {
    SCOPED_TRACE("gap " + std::to_string(gap));
    EXPECT_NEAR(volume_over_height({{0, {lower}}, {gap, {upper}}}), expected, 1e-6 * expected);
  }
  return expected;
}

TEST(Crossings, ASquareThatTurnsHasTheSameShapeForEveryGap) {
  for (const double angle : {3.0, 10.0, 22.0, 30.0, 44.0, 45.0, 60.0}) {
    SCOPED_TRACE("turned by " + std::to_string(angle));
    const double area = 50;
    const double side = std::sqrt(area);
    const double mean = over_any_gap(bar(side, side, 0.2), bar(side, side, 0.2 + angle * pi / 180));
    EXPECT_GT(mean, 0.9 * area);
    EXPECT_LT(mean, 1.15 * area);
  }
}

TEST(Crossings, ABarThatTurnsHasTheSameShapeForEveryGap) {
  for (const double length : {2.0, 5.0, 10.0, 40.0}) {
    for (const double angle : {5.0, 10.0, 45.0, 80.0}) {
      SCOPED_TRACE("length " + std::to_string(length) + " turned by " + std::to_string(angle));
      const double mean = over_any_gap(bar(length, 1, 0.1), bar(length, 1, 0.1 + angle * pi / 180));
      EXPECT_LT(mean, 1.3 * length);
    }
  }
}

TEST(Crossings, ALongBarThatTurnsIsNoLargerThanItsSlices) {
  std::vector<Slice> slices;
  for (int i = 0; i < 3; ++i) slices.push_back({10.0 * i, {bar(40, 1, i * pi / 4)}});
  EXPECT_LE(volume_over_height(slices), 40);
  EXPECT_GE(volume_over_height(slices), 20);
}

TEST(Crossings, ABladeThatTwistsKeepsItsVolume) {
  std::vector<Slice> slices;
  for (int i = 0; i < 10; ++i) slices.push_back({10.0 * i, {bar(40, 1, i * 5 * pi / 180)}});
  EXPECT_NEAR(volume_over_height(slices), 40, 4);
}

TEST(FanChange, IsMeasuredInProjection) {
  // A crossing one above the middle of a lower edge is pulled into the edge's end.
  const Vec3 crossing{0, 0, 1};
  const std::vector<Corners> fan{{Vec3{-1, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 2}}};
  EXPECT_NEAR(sideways_drift(crossing, fan), 0.5, 1e-15);
  EXPECT_NEAR(reach(crossing, fan), 1, 1e-15);
  for (const double height : {2.0, 0.02}) {
    std::vector<Corners> stretched = fan;
    for (Vec3& corner : stretched[0]) corner[2] *= height / 2;
    const Vec3 at{0, 0, height / 2};
    EXPECT_NEAR(std::abs(gained_area(at, stretched, height)), 1.0 / 6, 1e-14);
    EXPECT_NEAR(sideways_drift(at, stretched), 0.5, 1e-14);
    EXPECT_NEAR(worst_shape(stretched, 1 / height), worst_shape(fan, 0.5), 1e-14);
  }
  SheetsAround sheets;
  sheets.add({Vec3{0, 0, 0}, Vec3{4, 0, 1}, Vec3{1, 2, 1}});
  EXPECT_NEAR(sheets.area, 4, 1e-15);
  EXPECT_NEAR(sheets.width, 2, 1e-15);
}

}  // namespace
}  // namespace loft
