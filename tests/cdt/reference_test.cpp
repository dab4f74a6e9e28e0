// SPDX-License-Identifier: MIT
#include "tests/cdt/reference.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "cdt/predicates.h"
#include "tests/cdt/random_edits.h"

namespace loft::cdt {
namespace {

Picture picture_of(const std::vector<Outline>& outlines) { return Reference(outlines).picture(); }

std::vector<Outline> random_outlines(std::uint64_t seed, Ground ground) {
  Constraints constraints;
  for (const Edit& edit : random_script(seed, ground, 12, 5)) carry_out(edit, constraints);
  std::vector<Outline> outlines;
  for (const auto& [name, outline] : constraints) outlines.push_back(outline);
  return outlines;
}

double area(const Corners& c) {
  return ((c[1].x - c[0].x) * (c[2].y - c[0].y) - (c[2].x - c[0].x) * (c[1].y - c[0].y)) / 2;
}

TEST(Reference, SplitsCrossingSegments) {
  const Picture picture = picture_of({{{{0, 0}, {4, 4}}, open}, {{{4, 0}, {0, 4}}, open}});
  EXPECT_EQ(picture.vertices, (std::vector<Point>{{0, 0}, {0, 4}, {2, 2}, {4, 0}, {4, 4}}));
  EXPECT_EQ(picture.triangles.size(), 4U);
  ASSERT_EQ(picture.lines.size(), 4U);
  EXPECT_EQ(picture.lines[0], (Line{{0, 0}, {2, 2}, {{0, 0, true}}}));
  EXPECT_EQ(picture.lines[1], (Line{{0, 4}, {2, 2}, {{1, 0, false}}}));
}

TEST(Reference, SharesEdgesOfOverlappingSegments) {
  const Picture picture = picture_of({{{{2, 0}, {3, 0}}, open}, {{{4, 0}, {1, 0}}, open}});
  EXPECT_TRUE(picture.triangles.empty());
  ASSERT_EQ(picture.lines.size(), 3U);
  EXPECT_EQ(picture.lines[1], (Line{{2, 0}, {3, 0}, {{0, 0, true}, {1, 0, false}}}));
}

TEST(Reference, KeepsEveryRunOfASpike) {
  const Picture picture = picture_of(
      {{{{0, 0}, {10, 0}, {0, 0}, {0, 5}}, open}, {{{5, 0.1}}, open}, {{{5, -0.1}}, open}});
  EXPECT_EQ(picture.vertices.size(), 5U);
  EXPECT_EQ(picture.lines[1], (Line{{0, 0}, {10, 0}, {{0, 0, true}, {0, 1, false}}}));
}

TEST(Reference, MergesCrossingsOfThreeLinesThroughOnePoint) {
  // All through (1/3, 2/3), which is no double.
  const Picture picture = picture_of(
      {{{{0, 0}, {1, 2}}, open}, {{{0, 1}, {1, 0}}, open}, {{{0, 0.5}, {2, 1.5}}, open}});
  EXPECT_EQ(picture.vertices.size(), 7U);
  EXPECT_EQ(picture.lines.size(), 6U);
}

TEST(Reference, LeadsASegmentThroughEveryPointExactlyOnIt) {
  // The crossing is rounded, so that its vertex is no longer on one line with the others.
  const Picture picture =
      picture_of({{{{3, 3}, {7, 1}}, open}, {{{1, 1}, {4, 3}}, open}, {{{5, 2}}, open}});
  const bool is_led_through = std::ranges::any_of(picture.lines, [](const Line& line) {
    return line.low == Point{5, 2};
  });
  EXPECT_TRUE(is_led_through);
}

TEST(Reference, LeadsThroughWhatAPointOfASegmentRoundsTo) {
  // (0.3, 0.1) is no double, and hardly beside the line through 0 and (0.9, 0.3).
  const Picture picture = picture_of({{{{0, 0}, {0.9, 0.3}}, open}, {{{0.3, 0.1}}, open}});
  EXPECT_NE(orient({0, 0}, {0.9, 0.3}, {0.3, 0.1}), 0);
  EXPECT_EQ(picture.lines.size(), 2U);
}

// Near 0 the segment is at y = 1.48e-16, its chain, which leads through what it rounds to at x = 3,
// at 1.11e-16.
TEST(Reference, HasNoAnswerWhereAVertexIsBetweenASegmentAndItsChain) {
  const auto is_embeddable = [](double y) {
    const std::vector<Outline> outlines = {{{{-3, -1}, {6, 2.0000000000000004}}, open},
                                           {{{3, 1.0000000000000002}}, open},
                                           {{{0, y}}, open}};
    return Reference(outlines).is_embeddable();
  };
  EXPECT_TRUE(is_embeddable(1e-16));
  EXPECT_FALSE(is_embeddable(1.3e-16));
  EXPECT_TRUE(is_embeddable(2e-16));
}

TEST(Reference, CoversTheHullWithCounterClockwiseTriangles) {
  for (const Ground ground : {Ground::grid_8, Ground::grid_4, Ground::decimals}) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      SCOPED_TRACE(std::string(name_of(ground)) + ", seed " + std::to_string(seed));
      const std::vector<Outline> outlines = random_outlines(seed, ground);
      if (!Reference(outlines).is_embeddable()) continue;
      const Picture all = picture_of(outlines);
      double covered = 0;
      for (const Corners& corners : all.triangles) {
        EXPECT_EQ(orient(corners[0], corners[1], corners[2]), 1);
        covered += area(corners);
      }
      double hull = 0;
      std::vector<Outline> bare;
      for (const Point p : all.vertices) bare.push_back({{p}, open});
      for (const Corners& corners : picture_of(bare).triangles) hull += area(corners);
      EXPECT_NEAR(covered, hull, 1e-9 * hull);
    }
  }
}

TEST(Reference, DoesNotDependOnTheOrderOfConstraints) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    std::vector<Outline> outlines = random_outlines(seed, Ground::decimals);
    const Picture one = picture_of(outlines);
    std::ranges::reverse(outlines);
    const Picture other = picture_of(outlines);
    EXPECT_EQ(one.vertices, other.vertices);
    EXPECT_EQ(one.triangles, other.triangles);
  }
}

}  // namespace
}  // namespace loft::cdt
