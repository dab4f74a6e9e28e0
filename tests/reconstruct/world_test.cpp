// SPDX-License-Identifier: MIT
#include "reconstruct/world.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "reconstruct/reconstruct.h"

namespace loft {
namespace {

Slice square(double z, double half) {
  return {z, {{{{-half, -half}, {half, -half}, {half, half}, {-half, half}}, ""}}};
}

/// Turned by some angle about the x axis, and moved.
WorldFrame tilted(double angle) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  return {{{{1, 0, 0, 10}, {0, c, -s, 20}, {0, s, c, 30}, {0, 0, 0, 1}}}};
}

std::set<Vec3> places(const Surface& surface) {
  const Mesh mesh = to_mesh(surface);
  return {mesh.points.begin(), mesh.points.end()};
}

TEST(World, ASurfaceLeavesByTheFrame) {
  Stack stack;
  stack.slices = {square(0, 1), square(2, 1)};
  stack.frame = tilted(0.3);
  const Reconstructed made = reconstruct(stack);
  EXPECT_TRUE(check(made.surface).empty());
  EXPECT_NEAR(measure(made.surface).volume, 8, 1e-12);
  EXPECT_TRUE(places(made.surface).contains(stack.frame->at({1, -1, 2})));
}

TEST(World, PointsStayWhereTheFileHasThem) {
  Stack stack;
  stack.slices = {square(0, 1), square(2, 1)};
  stack.frame = tilted(0.3);
  for (Slice& slice : stack.slices)
    for (Contour& contour : slice.contours)
      for (const cdt::Point p : contour.points) {
        Vec3 place = stack.frame->at({p.x, p.y, slice.z});
        for (double& coordinate : place) coordinate = std::round(coordinate * 1e4) / 1e4;
        contour.places.push_back(place);
      }
  const Reconstructed made = reconstruct(stack);
  EXPECT_TRUE(check(made.surface).empty());
  EXPECT_TRUE(made.repairs.empty());
  const auto all = places(made.surface);
  for (const Vec3& place : stack.slices[1].contours[0].places) EXPECT_TRUE(all.contains(place));
}

TEST(World, PointsFarOffTheirPlanesAreMovedThere) {
  Stack stack;
  stack.slices = {square(0, 1), square(2, 1)};
  stack.frame = WorldFrame();
  for (Slice& slice : stack.slices)
    for (Contour& contour : slice.contours)
      for (const cdt::Point p : contour.points) contour.places.push_back({p.x, p.y, -slice.z});
  stack.slices[1].contours[0].places[2] = {0, 0, 5};
  stack.slices[0].contours[0].places[0] = {0, 0, -5};
  const Reconstructed made = reconstruct(stack);
  EXPECT_TRUE(check(made.surface).empty());
  ASSERT_EQ(made.repairs.size(), 1U);
  EXPECT_EQ(made.repairs[0].kind, DefectKind::off_plane);
  EXPECT_NEAR(measure(made.surface).volume, 8, 1e-12);
}

TEST(CapExtend, GivesSlicesTheirThickness) {
  const std::vector<Slice> slices{square(0, 1), square(2, 1), square(3, 1)};
  const Reconstructed made = reconstruct(slices, {.cap = Cap::extend});
  EXPECT_TRUE(check(made.surface).empty());
  EXPECT_NEAR(measure(made.surface).volume, 4 * (1 + 3 + 0.5), 1e-12);
  EXPECT_NEAR(made.slab_volume, 4 * (1 + 3 + 0.5), 1e-12);
}

TEST(CapExtend, GivesOneSliceThatOfItsLabel) {
  Stack stack;
  stack.slices = {square(7, 1)};
  stack.slices[0].contours[0].label = "seed";
  EXPECT_THROW(static_cast<void>(reconstruct(stack, {.cap = Cap::extend})), InputError);
  stack.gap = 2;
  EXPECT_NEAR(measure(reconstruct(stack, {.cap = Cap::extend}).surface).volume, 8, 1e-12);
  stack.labels = {{"seed", {}, "", "", 3.0}};
  const Reconstructed made = reconstruct(stack, {.cap = Cap::extend, .label = "seed"});
  EXPECT_NEAR(measure(made.surface).volume, 12, 1e-12);
  EXPECT_NEAR(made.slab_volume, 12, 1e-12);
}

TEST(CapExtend, TakesNoNoticeOfEmptySlicesBeyondTheEnds) {
  const std::vector<Slice> slices{{-1, {}},     {-0.5, {}},   square(0, 1), {1, {}},
                                  square(2, 1), square(3, 1), {4, {}}};
  const auto made = reconstruct(slices, {.cap = Cap::extend});
  EXPECT_TRUE(check(made.surface).empty());
  const Mesh mesh = to_mesh(made.surface);
  const auto [low, high] = std::ranges::minmax(mesh.points, {}, [](const Vec3& p) { return p[2]; });
  EXPECT_EQ(low[2], -0.5);
  EXPECT_EQ(high[2], 3.5);
}

}  // namespace
}  // namespace loft
