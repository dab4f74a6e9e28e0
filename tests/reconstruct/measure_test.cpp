// SPDX-License-Identifier: MIT
#include "reconstruct/measure.h"

#include <gtest/gtest.h>

#include <numbers>

#include "tests/reconstruct/shapes.h"

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

TEST(Measure, CountsOnlyVerticesThatFacesUse) {
  Mesh mesh = cube({0, 0, 0}, 1);
  mesh.points.push_back({9, 9, 9});
  EXPECT_EQ(measure(mesh).vertices, 8U);
  EXPECT_EQ(measure(mesh).genus, 0);
}

}  // namespace
}  // namespace loft
