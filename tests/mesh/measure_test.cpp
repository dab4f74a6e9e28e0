// SPDX-License-Identifier: MIT
#include "mesh/measure.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/mesh/shapes.h"

namespace loft {
namespace {

using shapes::cube;
using shapes::flipped;
using shapes::moved;
using shapes::operator+;
using shapes::torus;

TEST(Measure, OfNothingIsNothing) {
  const Measures m = measure(Mesh{});
  EXPECT_EQ(m.vertices + m.edges + m.faces + m.components, 0U);
  EXPECT_EQ(m.genus, 0);
  EXPECT_EQ(m.area, 0);
  EXPECT_EQ(m.volume, 0);
}

TEST(Measure, OfACubeIsExact) {
  const Measures m = measure(cube({1, 2, 3}, 2));
  EXPECT_EQ(m.vertices, 8U);
  EXPECT_EQ(m.edges, 18U);
  EXPECT_EQ(m.faces, 12U);
  EXPECT_EQ(m.components, 1U);
  EXPECT_EQ(m.genus, 0);
  EXPECT_DOUBLE_EQ(m.area, 24);
  EXPECT_DOUBLE_EQ(m.volume, 8);
}

TEST(Measure, OfATorusConverges) {
  const Measures m = measure(torus(3, 1, 600, 300));
  EXPECT_EQ(m.genus, 1);
  EXPECT_EQ(m.components, 1U);
  const double pi = std::numbers::pi;
  EXPECT_NEAR(m.volume, 2 * pi * pi * 3, 2e-4 * m.volume);
  EXPECT_NEAR(m.area, 4 * pi * pi * 3, 2e-4 * m.area);
}

TEST(Measure, AddsUpComponents) {
  const Mesh holed = cube({-5, -5, -5}, 10) + flipped(torus(3, 1, 20, 10));
  const Measures m = measure(holed + torus(1, 0.5, 20, 10));
  EXPECT_EQ(m.components, 3U);
  EXPECT_EQ(m.genus, 2);
  EXPECT_NEAR(measure(holed).volume, 1000 - measure(torus(3, 1, 20, 10)).volume, 1e-11);
}

TEST(Measure, IsNegativeInsideOut) {
  EXPECT_DOUBLE_EQ(measure(flipped(cube({1, 2, 3}, 2))).volume, -8);
}

TEST(Measure, IsAsAccurateFarFromTheOrigin) {
  const Measures m = measure(moved(cube({0, 0, 0}, 0.5), {5e6, -5e6, 5e6}));
  EXPECT_DOUBLE_EQ(m.volume, 0.125);
  EXPECT_DOUBLE_EQ(m.area, 1.5);
}

TEST(Measure, CountsTheHandlesOfAnOpenSurface) {
  Mesh tube = cube({0, 0, 0}, 1);
  tube.faces.erase(tube.faces.begin(), tube.faces.begin() + 4);  // bottom and top
  EXPECT_EQ(measure(tube).genus, 0);
  Mesh open_torus = torus(3, 1, 20, 10);
  open_torus.faces.pop_back();
  EXPECT_EQ(measure(open_torus).genus, 1);
  EXPECT_EQ(measure(open_torus + tube).genus, 1);
}

TEST(Measure, TellsTheAnglesOfTriangles) {
  const Angles cubed = measure(cube({1, 2, 3}, 2)).angles;
  EXPECT_DOUBLE_EQ(cubed.smallest, 45);
  EXPECT_NEAR(cubed.fifth_percentile, 45, 0.01);
  EXPECT_NEAR(cubed.median, 45, 0.01);
  EXPECT_DOUBLE_EQ(cubed.worst_aspect, std::sqrt(3));
  const double high = std::sqrt(0.75);
  const Mesh even{{{0, 0, 7}, {1, 0, 7}, {0.5, high, 7}}, {{0, 1, 2}}};
  EXPECT_NEAR(measure(even).angles.smallest, 60, 1e-12);
  EXPECT_NEAR(measure(even).angles.worst_aspect, 1, 1e-12);
  EXPECT_EQ(measure(Mesh{}).angles.median, 0);
}

TEST(Measure, NoPercentileOfAnglesIsBelowTheSmallest) {
  const double angle = 10.009 * std::numbers::pi / 180;  // in the upper half of a bin
  const Mesh mesh{{{0, 0, 0}, {1, 0, 0}, {std::cos(angle), std::sin(angle), 0}}, {{0, 1, 2}}};
  const Angles angles = measure(mesh).angles;
  EXPECT_NEAR(angles.smallest, 10.009, 1e-12);
  EXPECT_GE(angles.fifth_percentile, angles.smallest);
  EXPECT_GE(angles.median, angles.smallest);
}

TEST(Measure, AnglesArePercentilesOfTriangles) {
  Mesh mesh;
  for (std::uint32_t i = 0; i < 40; ++i) {  // angles of 1 to 40 degrees at the origin
    const double angle = (i + 1) * std::numbers::pi / 180;
    const auto n = static_cast<std::uint32_t>(mesh.points.size());
    mesh.points.insert(mesh.points.end(),
                       {{0, 0, 0}, {1, 0, 0}, {std::cos(angle), std::sin(angle), 0}});
    mesh.faces.push_back({n, n + 1, n + 2});
  }
  const Angles angles = measure(mesh).angles;
  EXPECT_NEAR(angles.smallest, 1, 1e-12);
  EXPECT_NEAR(angles.fifth_percentile, 3, 0.01);
  EXPECT_NEAR(angles.median, 21, 0.01);
}

TEST(Measure, ADegenerateTriangleHasNoAngle) {
  const Mesh flat{{{0, 0, 0}, {1, 1, 1}, {3, 3, 3}}, {{0, 1, 2}}};
  EXPECT_EQ(measure(flat).angles.smallest, 0);
  EXPECT_TRUE(std::isinf(measure(flat).angles.worst_aspect));
}

TEST(Measure, CountsOnlyVerticesThatFacesUse) {
  Mesh mesh = cube({0, 0, 0}, 1);
  mesh.points.push_back({9, 9, 9});
  EXPECT_EQ(measure(mesh).vertices, 8U);
  EXPECT_EQ(measure(mesh).genus, 0);
}

}  // namespace
}  // namespace loft
