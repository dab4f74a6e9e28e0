// SPDX-License-Identifier: MIT
#include "reconstruct/region.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "cdt/predicates.h"
#include "tests/reconstruct/stacks.h"

namespace loft {
namespace {

using cdt::Point;

Region clean_slice(const Slice& slice, std::vector<Defect>& repairs, Fill fill = Fill::even_odd) {
  std::vector<ContourSource> sources;
  for (std::uint32_t c = 0; c < slice.contours.size(); ++c)
    sources.push_back({slice.contours[c].points, 0, c});
  return clean(sources, slice.z, {fill}, repairs);
}

double area(const Region& region) {
  double twice = 0;
  for (std::size_t i = 0; i < region.loop_count(); ++i) {
    const auto loop = region.loop(i);
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const Point a = region.points[loop[k]];
      const Point b = region.points[loop[(k + 1) % loop.size()]];
      twice += a.x * b.y - a.y * b.x;
    }
  }
  return twice / 2;
}

std::vector<DefectKind> kinds(const std::vector<Defect>& repairs) {
  std::vector<DefectKind> found;
  for (const Defect& defect : repairs) found.push_back(defect.kind);
  return found;
}

TEST(Clean, KeepsTheVerticesOfACleanSliceOneForOne) {
  const Slice slice{2.5,
                    {stacks::circle(9, 5), stacks::circle(7, 2), stacks::circle(5, 1, {9, 0})}};
  std::vector<Defect> repairs;
  const Region region = clean_slice(slice, repairs);
  EXPECT_TRUE(repairs.empty());
  EXPECT_EQ(region.z, 2.5);
  EXPECT_EQ(region.loop_count(), 3U);
  ASSERT_EQ(region.points.size(), 21U);
  for (std::size_t i = 0; i < region.points.size(); ++i) {
    const Origin& origin = region.origins[i];
    EXPECT_EQ(origin.kind, VertexKind::contour);
    EXPECT_EQ(slice.contours[origin.contour].points[origin.point], region.points[i]);
  }
}

TEST(Clean, TurnsTheRegionToTheLeftWhateverTheOrientation) {
  for (int reversed = 0; reversed < 4; ++reversed) {
    Slice slice{0, {stacks::square(3), stacks::square(1)}};
    for (unsigned c = 0; c < 2; ++c)
      if ((reversed >> c & 1) != 0) std::ranges::reverse(slice.contours[c].points);
    std::vector<Defect> repairs;
    EXPECT_DOUBLE_EQ(area(clean_slice(slice, repairs)), 36 - 4);
    EXPECT_TRUE(repairs.empty());
  }
}

TEST(Clean, DropsWhatHasNoArea) {
  Slice slice{0, {stacks::square(3)}};
  slice.contours.push_back({{}, {}});
  slice.contours.push_back({{{9, 9}}, {}});
  slice.contours.push_back({{{9, 9}, {8, 8}}, {}});
  slice.contours.push_back({{{9, 9}, {8, 8}, {9, 9}}, {}});
  slice.contours.push_back({{{9, 9}, {8, 8}, {7, 7}}, {}});
  std::vector<Defect> repairs;
  const Region region = clean_slice(slice, repairs);
  EXPECT_DOUBLE_EQ(area(region), 36);
  EXPECT_EQ(region.points.size(), 4U);
  using enum DefectKind;
  EXPECT_EQ(kinds(repairs), (std::vector{too_few_points, too_few_points, too_few_points,
                                         too_few_points, zero_area}));
  for (std::uint32_t i = 0; i < repairs.size(); ++i) EXPECT_EQ(repairs[i].contour, i + 1);
}

TEST(Clean, DropsACopyOfAContourHoweverItIsWritten) {
  Slice slice{0, {stacks::square(3), stacks::square(3)}};
  std::ranges::reverse(slice.contours[1].points);
  std::vector<Point>& copy = slice.contours[1].points;
  std::rotate(copy.begin(), copy.begin() + 1, copy.end());
  slice.contours[1].points.push_back(slice.contours[1].points.front());
  std::vector<Defect> repairs;
  EXPECT_DOUBLE_EQ(area(clean_slice(slice, repairs)), 36);
  EXPECT_EQ(kinds(repairs), std::vector{DefectKind::repeated_contour});
}

TEST(Clean, RemovesASpikeAndKeepsTheVertexWhereItStood) {
  Slice slice{0, {{{{0, 0}, {4, 0}, {4, 4}, {2, 4}, {2, 30}, {2, 4}, {0, 4}}, {}}}};
  std::vector<Defect> repairs;
  const Region region = clean_slice(slice, repairs);
  EXPECT_EQ(region.points.size(), 5U);
  EXPECT_DOUBLE_EQ(area(region), 16);
  EXPECT_EQ(kinds(repairs), std::vector{DefectKind::spike});
}

TEST(Clean, LeavesNoVertexWhereASpikeCrossedTheOutline) {
  // The spike runs across the whole square and out on the far side.
  Slice slice{0, {{{{0, 0}, {3, 0}, {4, 9}, {3, 0}, {7, 0}, {7, 3}, {0, 3}}, {}}}};
  std::vector<Defect> repairs;
  const Region region = clean_slice(slice, repairs);
  EXPECT_EQ(region.points.size(), 5U);
  EXPECT_DOUBLE_EQ(area(region), 21);
}

TEST(Clean, ResolvesCrossingsByTheFillRule) {
  const Slice slice{0, {stacks::square(2), stacks::square(2, {1, 1})}};
  std::vector<Defect> repairs;
  const Region apart = clean_slice(slice, repairs);
  EXPECT_DOUBLE_EQ(area(apart), 2 * (16 - 9));
  ASSERT_EQ(kinds(repairs), std::vector{DefectKind::overlap});
  EXPECT_DOUBLE_EQ(repairs.front().area, 9);
  EXPECT_EQ(apart.points.size(), 10U);
  EXPECT_EQ(std::ranges::count(apart.origins, VertexKind::cleaning, &Origin::kind), 2);
  const Region joined = clean_slice(slice, repairs, Fill::nonzero);
  EXPECT_DOUBLE_EQ(area(joined), 32 - 9);
  EXPECT_EQ(joined.points.size(), 8U);
}

TEST(Clean, SplitsABowTieIntoTwoLoopsThatMeet) {
  const Slice slice{0, {{{{0, 0}, {4, 4}, {4, 0}, {0, 4}}, {}}}};
  std::vector<Defect> repairs;
  const Region region = clean_slice(slice, repairs);
  EXPECT_EQ(region.loop_count(), 2U);
  EXPECT_EQ(region.points.size(), 5U);
  EXPECT_DOUBLE_EQ(area(region), 8);
  EXPECT_EQ(kinds(repairs), std::vector{DefectKind::self_crossing});
}

TEST(Clean, MakesLoopsThatMeetOnlyInVertices) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    const Slice slice = stacks::random_slice(0, random, seed % 2 == 0);
    for (const Fill fill : {Fill::even_odd, Fill::nonzero}) {
      std::vector<Defect> repairs;
      const Region region = clean_slice(slice, repairs, fill);
      EXPECT_GE(area(region), 0);
      cdt::Triangulation mesh;
      insert_loops(region, mesh);
      EXPECT_EQ(mesh.vertex_count(), region.points.size());
      for (std::uint32_t e = 0; e < mesh.edge_bound(); ++e)
        EXPECT_LE(mesh.passages(cdt::EdgeId(e)).size(), 1U);
    }
  }
}

}  // namespace
}  // namespace loft
