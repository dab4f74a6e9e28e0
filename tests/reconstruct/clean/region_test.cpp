// SPDX-License-Identifier: MIT
#include "reconstruct/clean/region.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "cdt/predicates.h"
#include "reconstruct/clean/cleaning.h"
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

TEST(Clean, DropsWhatHasNoAreaInsideAnOutline) {
  Slice slice{0, {stacks::square(3)}};
  slice.contours.push_back({{}, {}});
  slice.contours.push_back({{{3, 0}}, {}});
  slice.contours.push_back({{{1, 1}, {2, 2}}, {}});
  slice.contours.push_back({{{1, 1}, {9, 8}, {1, 1}}, {}});
  slice.contours.push_back({{{9, 9}, {0, 0}, {-7, -7}}, {}});
  std::vector<Defect> repairs;
  const Region region = clean_slice(slice, repairs);
  EXPECT_DOUBLE_EQ(area(region), 36);
  EXPECT_EQ(region.points.size(), 4U);
  using enum DefectKind;
  std::set<std::uint32_t> contours;
  for (const Defect& repair : repairs) contours.insert(*repair.contour);
  EXPECT_EQ(contours, (std::set<std::uint32_t>{1, 2, 3, 4, 5}));
  EXPECT_EQ(std::ranges::count(kinds(repairs), zero_area), 1);
  EXPECT_EQ(std::ranges::count(kinds(repairs), too_few_points), 4);
}

TEST(Clean, KeepsWhatHasNoAreaBesideTheRegionAsLines) {
  Slice slice{0, {stacks::square(3)}};
  slice.contours.push_back({{{9, 9}, {7, 7}, {8, 8}}, {}});
  slice.contours.push_back({{{5, 0}}, {}});
  std::vector<Defect> repairs;
  const Region region = clean_slice(slice, repairs);
  EXPECT_TRUE(repairs.empty());
  EXPECT_FALSE(is_simple(region));
  EXPECT_EQ(region.loop_points().size(), 4U);
  ASSERT_EQ(region.line_count(), 2U);
  const auto at = [&](std::size_t line, std::size_t i) {
    return region.points[region.line(line)[i]];
  };
  ASSERT_EQ(region.line(0).size(), 3U);
  EXPECT_EQ(at(0, 0), (Point{7, 7}));
  EXPECT_EQ(at(0, 1), (Point{8, 8}));
  EXPECT_EQ(at(0, 2), (Point{9, 9}));
  EXPECT_EQ(region.origins[region.line(0)[0]], (Origin{VertexKind::contour, 0, 1, 1}));
  EXPECT_EQ(at(1, 0), (Point{5, 0}));
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

TEST(Clean, ReportsContoursThatCrossInCommonCornersOnly) {
  // A square and a diamond through the middles of its sides, which are corners of both.
  const Slice slice{0,
                    {{{{0, 0}, {2, 0}, {4, 0}, {4, 4}, {2, 4}, {0, 4}}, {}},
                     {{{2, 0}, {6, 2}, {2, 4}, {1, 2}}, {}}}};
  std::vector<Defect> repairs;
  const Region region = clean_slice(slice, repairs);
  ASSERT_EQ(kinds(repairs), std::vector{DefectKind::overlap});
  EXPECT_EQ(repairs[0].contour, 1U);
  EXPECT_EQ(repairs[0].place, (Point{2, 0}));
  EXPECT_DOUBLE_EQ(area(region), 16 + 10 - 2 * repairs[0].area);
}

TEST(Clean, CountsAnAreaOnceHoweverManyContoursEncloseIt) {
  const Slice slice{0,
                    {stacks::square(2), stacks::square(2, {1, 0.5}), stacks::square(2, {0.5, 1})}};
  std::vector<Defect> repairs;
  const Region region = clean_slice(slice, repairs, Fill::nonzero);
  ASSERT_EQ(repairs.size(), 3U);
  double decided = 0;
  for (const Defect& defect : repairs) {
    EXPECT_EQ(defect.kind, DefectKind::overlap);
    decided += defect.area;
  }
  const double all_three = 3 * 3;
  EXPECT_DOUBLE_EQ(decided, 48 - area(region) - all_three);
}

TEST(Clean, SaysWhatACrossingWithManyPlacesIsAsOne) {
  // Two combs across each other.
  Contour comb;
  for (int i = 0; i < 40; ++i) {
    comb.points.push_back({2.0 * i, 0});
    comb.points.push_back({2.0 * i, 100});
    comb.points.push_back({2.0 * i + 1, 100});
    comb.points.push_back({2.0 * i + 1, 0});
  }
  comb.points.insert(comb.points.end(), {{80, -1}, {0, -1}});
  Contour across = comb;
  for (Point& p : across.points) p = {p.y - 10.5, p.x + 5.5};
  std::vector<Defect> repairs;
  (void)clean_slice({0, {comb, across}}, repairs);
  ASSERT_EQ(kinds(repairs), std::vector{DefectKind::overlap});
  EXPECT_DOUBLE_EQ(repairs[0].area, 40 * 40);
}

TEST(Clean, GivesTheSameWhicheverOfTwoOppositeCopiesComesFirst) {
  for (const Fill fill : {Fill::even_odd, Fill::nonzero, Fill::keyhole_aware}) {
    Slice slice{0, {stacks::square(3), stacks::square(1), stacks::square(1)}};
    std::ranges::reverse(slice.contours[1].points);
    std::vector<Defect> repairs;
    const double one = area(clean_slice(slice, repairs, fill));
    std::swap(slice.contours[1], slice.contours[2]);
    const double other = area(clean_slice(slice, repairs, fill));
    EXPECT_EQ(one, other);
    EXPECT_DOUBLE_EQ(one, fill == Fill::nonzero ? 36 : 36 - 4);
    EXPECT_EQ(std::ranges::count(kinds(repairs), DefectKind::repeated_contour), 2);
  }
}

TEST(Clean, KeepsAContourOnceThatGoesRoundTwice) {
  for (const Fill fill : {Fill::even_odd, Fill::nonzero}) {
    Slice slice{0, {stacks::circle(7, 2)}};
    const std::vector<Point> once = slice.contours[0].points;
    for (int lap = 0; lap < 2; ++lap)
      slice.contours[0].points.insert(slice.contours[0].points.end(), once.begin(), once.end());
    std::vector<Defect> repairs;
    const Region region = clean_slice(slice, repairs, fill);
    EXPECT_EQ(region.points.size(), 7U);
    EXPECT_EQ(kinds(repairs), std::vector{DefectKind::repeated_contour});
    for (const Origin& origin : region.origins) EXPECT_EQ(origin.kind, VertexKind::contour);
  }
}

TEST(Clean, ReportsACornerOnASide) {
  const Slice slice{0, {stacks::square(2), stacks::square(1, {3, 0.5})}};
  std::vector<Defect> repairs;
  const Region region = clean_slice(slice, repairs);
  EXPECT_EQ(kinds(repairs), std::vector{DefectKind::touching});
  EXPECT_DOUBLE_EQ(area(region), 20);
}

TEST(Clean, ReportsACornerOnASideWithoutASharedPart) {
  const Slice slice{0, {stacks::square(2), {{{2, 0}, {3, -1}, {3, 1}}, {}}}};
  std::vector<Defect> repairs;
  EXPECT_EQ(clean_slice(slice, repairs).points.size(), 7U);
  ASSERT_EQ(kinds(repairs), std::vector{DefectKind::touching});
  EXPECT_EQ(repairs[0].place, (Point{2, 0}));
}

// Three sides of a contour go through one place that is no corner; what is around it alternates.
TEST(Clean, ReportsAPlaceThatAContourPassesThreeTimes) {
  const Slice slice{0, {{{{1, 0}, {0, 2}, {2, 2}, {2, 1}, {0, 3}, {1, 3}}, {}}}};
  std::vector<Defect> repairs;
  (void)clean_slice(slice, repairs);
  EXPECT_EQ(kinds(repairs), std::vector{DefectKind::self_crossing});
}

TEST(Clean, SaysNothingOfCornerContacts) {
  const Slice slice{0, {stacks::square(1), stacks::square(1, {2, 2}), stacks::square(9)}};
  std::vector<Defect> repairs;
  EXPECT_EQ(clean_slice(slice, repairs).points.size(), 11U);
  EXPECT_TRUE(repairs.empty());
}

TEST(Clean, ReportsContoursThatWindingNumbersMakeNoHole) {
  const Slice slice{0, {stacks::square(3), stacks::square(1)}};
  std::vector<Defect> repairs;
  EXPECT_DOUBLE_EQ(area(clean_slice(slice, repairs, Fill::nonzero)), 36);
  ASSERT_EQ(kinds(repairs), std::vector{DefectKind::covered});
  EXPECT_EQ(repairs[0].contour, 1U);
  EXPECT_DOUBLE_EQ(repairs[0].area, 4);
}

TEST(Clean, ClosesTheSlitOfAKeyhole) {
  const double hair = 1e-3;
  const Slice slice{0,
                    {{{{-3, -3},
                       {3, -3},
                       {3, 3},
                       {0, 3},
                       {0, 1},
                       {-1, -1},
                       {1, -1},
                       {hair, 1},
                       {hair, 3 + hair},
                       {-3, 3}},
                      {}}}};
  std::vector<Defect> repairs;
  EXPECT_EQ(clean_slice(slice, repairs).loop_count(), 1U);
  EXPECT_TRUE(repairs.empty() || repairs[0].kind == DefectKind::self_crossing);
  repairs.clear();
  const Region region = clean_slice(slice, repairs, Fill::keyhole_aware);
  EXPECT_EQ(region.loop_count(), 2U);
  EXPECT_EQ(kinds(repairs), std::vector{DefectKind::keyhole});
  EXPECT_NEAR(area(region), 36 - 2, 0.01);
  EXPECT_NEAR(repairs[0].area, 2 * hair, hair / 2);
}

TEST(Clean, TakesHolesAsContoursOfTheirOwnAlsoWhereItLooksForKeyholes) {
  const Slice slice{0, {stacks::square(3), stacks::square(2), stacks::square(1)}};
  std::vector<Defect> repairs;
  EXPECT_DOUBLE_EQ(area(clean_slice(slice, repairs, Fill::keyhole_aware)), 36 - 16 + 4);
  EXPECT_TRUE(repairs.empty());
}

TEST(Clean, JoinsWhatIsTooNearToBeToldApart) {
  // An outline given nearly twice, a point given nearly twice, a corner nearly on a side.
  const double hair = 1e-14;
  const Slice slice{0,
                    {stacks::square(3),
                     stacks::square(3 - hair),
                     {{{5, 0}, {6, 0}, {6, hair}, {6, 1}}, {}},
                     {{{9, 0}, {12, 0}, {12, 3}, {9, 3}}, {}},
                     {{{12 + hair, 1}, {13, 0}, {13, 2}}, {}}}};
  std::vector<Defect> repairs;
  const Region region = clean_slice(slice, repairs);
  EXPECT_NEAR(area(region), 36 + 0.5 + 9 + 1, 1e-9);
  EXPECT_EQ(region.points.size(), 4U + 3U + 5U + 2U);
  EXPECT_FALSE(repairs.empty());
}

/// Whether a point is inside by the contours as they came, taken one by one (exact).
bool is_enclosed(const Slice& slice, Point p, Fill fill) {
  int crossings = 0;
  int winding = 0;
  for (const Contour& contour : slice.contours) {
    for (std::size_t i = 0; i < contour.points.size(); ++i) {
      const Point a = contour.points[i];
      const Point b = contour.points[(i + 1) % contour.points.size()];
      if ((a.y <= p.y) == (b.y <= p.y) || cdt::orient(a, b, p) != (b.y > a.y ? 1 : -1)) continue;
      ++crossings;
      winding += b.y > a.y ? 1 : -1;
    }
  }
  return fill == Fill::nonzero ? winding != 0 : crossings % 2 == 1;
}

TEST(Clean, EnclosesWhatTheRuleSays) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    const Slice slice = stacks::random_slice(0, random, seed % 2 == 0);
    for (const Fill fill : {Fill::even_odd, Fill::nonzero, Fill::keyhole_aware}) {
      std::vector<Defect> repairs;
      const Region region = clean_slice(slice, repairs, fill);
      const auto is_changed = [](const Defect& defect) {
        return defect.kind == DefectKind::repeated_contour || defect.kind == DefectKind::keyhole;
      };
      if (std::ranges::any_of(repairs, is_changed)) continue;
      Slice made{0, {}};
      for (std::size_t i = 0; i < region.loop_count(); ++i) {
        made.contours.emplace_back();
        for (const std::uint32_t v : region.loop(i))
          made.contours.back().points.push_back(region.points[v]);
      }
      for (int k = 0; k < 50; ++k) {
        const Point p{7 * std::generate_canonical<double, 53>(random),
                      7 * std::generate_canonical<double, 53>(random)};
        EXPECT_EQ(is_enclosed(slice, p, fill), is_enclosed(made, p, Fill::even_odd));
      }
    }
  }
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
      EXPECT_EQ(mesh.vertex_count(), region.loop_points().size());
      for (std::uint32_t e = 0; e < mesh.edge_bound(); ++e)
        EXPECT_LE(mesh.passages(cdt::EdgeId(e)).size(), 1U);
    }
  }
}

}  // namespace
}  // namespace loft
