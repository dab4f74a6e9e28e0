// SPDX-License-Identifier: MIT
#include "reconstruct/tile/contacts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "mesh/measure.h"
#include "reconstruct/clean/cleaning.h"
#include "reconstruct/reconstruct.h"
#include "tests/reconstruct/solid.h"
#include "tests/reconstruct/stacks.h"

namespace loft {
namespace {

using cdt::Point;
using testing::ElementsAre;

constexpr double contact = 1e-9;
constexpr double hair = 1e-10;

Region region_of(const std::vector<Point>& outline, double z) {
  const std::vector<ContourSource> sources{{outline, 0, 0}};
  std::vector<Defect> repairs;
  return clean(sources, z, {}, repairs);
}

TEST(Contacts, LeadsASideThroughAVertexBesideIt) {
  const Region lower = region_of({{0, 0}, {10, 0}, {0, 10}}, 0);
  const Region upper = region_of({{4, -hair}, {7, hair}, {5, -3}}, 1);
  const auto paths = meet_exactly(lower, upper, {}, contact);
  ASSERT_TRUE(paths);
  EXPECT_THAT((*paths)[0].points, ElementsAre(Point{0, 0}, Point{4, -hair}, Point{7, hair},
                                              Point{10, 0}, Point{0, 10}));
  EXPECT_THAT((*paths)[0].side_starts, ElementsAre(0, 3, 4, 5));
  EXPECT_THAT((*paths)[0].loop_starts, ElementsAre(0, 5));
  EXPECT_EQ((*paths)[1].points.size(), 3U);
}

TEST(Contacts, MakesVerticesOneThatTouch) {
  const Region lower = region_of({{0, 0}, {10, 0}, {0, 10}}, 0);
  const Region upper = region_of({{10 + hair, hair}, {20, 0}, {20, 10}}, 1);
  const auto paths = meet_exactly(lower, upper, {}, contact);
  ASSERT_TRUE(paths);
  EXPECT_THAT((*paths)[1].points, testing::Contains(Point{10, 0}));
  EXPECT_EQ((*paths)[0].points.size(), 3U);
}

TEST(Contacts, AreNotMadeWhereAVertexTouchesTwo) {
  const Region lower = region_of({{0, 0}, {10, 0}, {10, hair}, {0, 10}}, 0);
  const Region upper = region_of({{10 + hair, hair / 2}, {20, 0}, {20, 10}}, 1);
  EXPECT_FALSE(meet_exactly(lower, upper, {}, contact));
}

/// All its sides are led through one vertex of the other slice, so that nothing is left inside.
TEST(Contacts, ASpeckThatIsHardlyLargerThanAContactKeepsItsPlace) {
  const double r = 2.5e-8;
  const double x = 110;
  const double y = 10;
  const Contour square{{{0, 0}, {100, 0}, {100, 100}, {0, 100}}, {}};
  const Contour speck{
      {{x + r * std::sqrt(3), y - r}, {x, y + 2 * r}, {x - r * std::sqrt(3), y - r}}, {}};
  const Contour spike{{{x, y}, {117, 40}, {113, 40}}, {}};
  const std::vector<Slice> slices{{0, {square, speck}}, {1, {square, spike}}};
  std::vector<Options> all(3);
  all[1].link = LinkRule::none;
  all[2].link = LinkRule::overlap;
  all[2].links = {{{0, 1}, {1, 1}, true, {}}};
  for (const Options& options : all) {
    const Reconstructed made = reconstruct(slices, options);
    EXPECT_EQ(solids::faults(made.surface), "");
    const Mesh mesh = to_mesh(made.surface);
    for (const Slice& slice : slices)
      for (const Contour& contour : slice.contours)
        for (const Point p : contour.points)
          EXPECT_THAT(mesh.points, testing::Contains(Vec3{p.x, p.y, slice.z}));
  }
}

}  // namespace
}  // namespace loft
