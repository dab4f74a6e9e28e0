// SPDX-License-Identifier: MIT
#include "overlay/coverage.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "cdt/each_once.h"
#include "cdt/predicates.h"
#include "overlay/cut.h"
#include "overlay/faces.h"
#include "overlay/inscribed.h"
#include "tests/cases.h"
#include "tests/overlay/boxes.h"

namespace loft::overlay {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// A map of named areas.
struct Map {
  Overlay overlay;

  LayerId add(const std::string& name, const std::vector<Ring>& rings) {
    const LayerId layer = overlay.add_layer(name);
    for (const Ring& ring : rings) overlay.insert(layer, ring);
    return layer;
  }
};

TEST(Coverage, FindsOverlapsAndGapsWithTheirWidths) {
  Map map;
  const LayerId west = map.add("west", {box(0, 0, 4, 4)});
  const LayerId east = map.add("east", {{{3.5, 0}, {8, 0}, {8, 4}, {3.5, 4}}});
  const LayerId north =
      map.add("north", {{{0, 4}, {2, 4}, {4, 4.25}, {6, 4}, {8, 4}, {8, 9}, {0, 9}}});
  const CoverageFaults faults = check_coverage(map.overlay);
  ASSERT_EQ(faults.overlaps.size(), 1U);
  EXPECT_THAT(faults.overlaps[0].layers, ElementsAre(west, east));
  EXPECT_EQ(faults.overlaps[0].area.to_double(), 2);
  EXPECT_NEAR(faults.overlaps[0].width, 0.5, 5e-4);
  ASSERT_EQ(faults.gaps.size(), 1U);
  EXPECT_THAT(faults.gaps[0].layers, ElementsAre(west, east, north));
  EXPECT_EQ(faults.gaps[0].area.to_double(), 0.5);
  // A triangle with base 4 and height 1/4: twice its inradius.
  EXPECT_NEAR(faults.gaps[0].width, 4 * 0.5 / (4 + 2 * std::hypot(2, 0.25)), 3e-4);
}

TEST(Coverage, WidthsOfShapesWhoseDiscsAreKnown) {
  EXPECT_NEAR(inscribed_diameter({box(0, 0, 10, 1), {}}, 1e-3), 1, 1e-3);
  EXPECT_NEAR(inscribed_diameter({box(0, 0, 1, 1e-9), {}}, 1e-3), 1e-9, 1e-12);
  EXPECT_NEAR(inscribed_diameter({box(-3, -3, 3, 3), {box(-1, -1, 1, 1)}}, 1e-3),
              4 * (2 - std::sqrt(2)), 1e-2);
  Ring disc;
  for (int i = 0; i < 1000; ++i)
    disc.push_back({5 + 3 * std::cos(i * 2 * M_PI / 1000), 3 * std::sin(i * 2 * M_PI / 1000)});
  EXPECT_NEAR(inscribed_diameter({disc, {}}, 1e-3), 6, 6e-3);
  EXPECT_EQ(inscribed_diameter({}, 1e-3), 0);
}

TEST(Coverage, GivesOverlapsAndGapsToTheLongestBorder) {
  Map map;
  const LayerId west = map.add("west", {box(0, 0, 4, 4)});
  const LayerId east = map.add("east", {box(3, 1, 8, 3)});  // in 1 unit: 4 along west's
  const LayerId sea_rim = map.add("rim", {box(-9, -9, 20, 20), box(-5, -5, 15, 15)});
  const LayerId south = map.add("south", {{{0, 0}, {4, 0}, {2, -0.01}}});
  const LayerId deep = map.add("deep", {{{0, 0}, {2, -0.02}, {4, 0}, {4, -3}, {0, -3}}});
  const auto cleaned = clean_coverage(map.overlay, {.gap_width = 0.02});
  const auto area_of = [&](LayerId layer) { return area(cleaned[layer.index()]).to_double(); };
  EXPECT_EQ(area_of(west), 16);
  EXPECT_EQ(area_of(east), 8);
  EXPECT_EQ(area_of(sea_rim), 29 * 29 - 400);  // the sea is wider than that: it stays
  EXPECT_NEAR(area_of(south) + area_of(deep), 12, 1e-15);
  const auto first = clean_coverage(map.overlay, {.heir = Heir::first, .gap_width = 0.02});
  EXPECT_EQ(area(first[west.index()]).to_double(), 16);
}

TEST(Coverage, OfRandomMapsIsCleanAfterCleaning) {
  for (std::uint64_t seed = 0; seed < cases(150); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    const auto coordinate = [&] { return static_cast<double>(random() % 12); };
    Map map;
    for (int i = 0; i < 5; ++i) {
      std::vector<Ring> rings(1 + random() % 2);
      for (Ring& ring : rings)
        for (std::size_t k = 0; k < 3 + random() % 4; ++k)
          ring.push_back({coordinate(), coordinate()});
      map.add(std::to_string(i), rings);
    }
    const auto cleaned = clean_coverage(map.overlay, {.gap_width = 0.75});
    Map after;
    for (const MultiPolygon& polygons : cleaned) {
      std::vector<Ring> rings;
      for (const Polygon& polygon : polygons) {
        rings.push_back(polygon.outer);
        rings.insert(rings.end(), polygon.holes.begin(), polygon.holes.end());
      }
      after.add("", rings);
    }
    const CoverageFaults faults = check_coverage(after.overlay);
    ASSERT_THAT(faults.overlaps, IsEmpty());
    for (const CoverageFault& gap : faults.gaps) EXPECT_GE(gap.width, 0.75 * (1 - 2e-3));
    // What one alone had is still its own.
    const cdt::Triangulation& mesh = map.overlay.triangulation();
    for (std::uint32_t i = 0; i < mesh.triangle_bound(); ++i) {
      const cdt::TriangleId t(i);
      if (!mesh.is_triangle(t) || mesh.is_infinite(t)) continue;
      const auto layers = map.overlay.layers(map.overlay.cover(t));
      if (layers.size() != 1) continue;
      const auto e = cdt::Triangulation::edge(t);
      const Point a = mesh.point(mesh.from(e));
      const Point b = mesh.point(mesh.to(e));
      const Point c = mesh.point(mesh.apex(e));
      const Point middle{(a.x + b.x + c.x) / 3, (a.y + b.y + c.y) / 3};
      if (cdt::orient(a, b, middle) <= 0 || cdt::orient(b, c, middle) <= 0 ||
          cdt::orient(c, a, middle) <= 0)
        continue;
      ASSERT_EQ(after.overlay.cover(middle), (Cover{{layers.front()}, {}})) << middle;
    }
  }
}

TEST(Coverage, NeighboursShareTheirBorder) {  // libgeos/geos#889
  Map map;
  const LayerId a = map.add("a", {{{0, 0}, {0, 1}, {1, 0}}});
  const LayerId b = map.add("b", {{{0, 0}, {2, 0}, {0, -2}}});
  const SharedBorder border = shared_border(map.overlay, a, b);
  EXPECT_EQ(border.length, 1);
  EXPECT_THAT(border.lines, ElementsAre(std::vector<Point>{{0, 0}, {1, 0}}));
  ASSERT_EQ(neighbours(map.overlay, b).size(), 1U);
  EXPECT_EQ(neighbours(map.overlay, b)[0].layer, a);
  EXPECT_EQ(neighbours(map.overlay, b)[0].length, 1);
}

TEST(Coverage, AnEnclaveSharesItsWholeOutline) {
  Map map;
  const LayerId around = map.add("around", {box(0, 0, 9, 9), box(3, 3, 5, 5)});
  const LayerId within = map.add("within", {box(3, 3, 5, 5)});
  const SharedBorder border = shared_border(map.overlay, within, around);
  ASSERT_EQ(border.lines.size(), 1U);
  EXPECT_EQ(border.lines[0].front(), border.lines[0].back());
  EXPECT_EQ(border.length, 8);
  const Topology topology = arcs(map.overlay);
  EXPECT_EQ(topology.arcs.size(), 2U);
}

TEST(Coverage, ArcsAreEachThereOnceAndMakeTheMap) {
  for (std::uint64_t seed = 0; seed < cases(200); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    Map map;
    for (int i = 0; i < 6; ++i) {
      const auto x = static_cast<double>(random() % 8);
      const auto y = static_cast<double>(random() % 8);
      map.add(std::to_string(i), {box(x, y, x + 1 + static_cast<double>(random() % 4),
                                      y + 1 + static_cast<double>(random() % 4))});
    }
    const Topology topology = arcs(map.overlay);
    std::vector<std::pair<Point, Point>> pieces;
    for (const auto& arc : topology.arcs)
      for (std::size_t i = 1; i < arc.size(); ++i)
        pieces.push_back(std::minmax(arc[i - 1], arc[i]));
    const std::size_t count = pieces.size();
    cdt::keep_each_once(pieces);
    ASSERT_EQ(pieces.size(), count);
    for (std::uint32_t l = 0; l < 6; ++l)
      ASSERT_EQ(polygons(topology, LayerId(l)),
                map.overlay.polygons(map.overlay.watch(LayerId(l)), Vertices::all));
  }
}

TEST(Faces, AreThePartsOfThePlane) {
  Map map;
  const LayerId a = map.add("a", {box(0, 0, 2, 2)});
  const LayerId b = map.add("b", {box(1, 0, 3, 2), box(10, 0, 11, 1)});
  EXPECT_THAT(faces(map.overlay),
              ElementsAre(Face{{a}, {box(0, 0, 1, 2), {}}}, Face{{a, b}, {box(1, 0, 2, 2), {}}},
                          Face{{b}, {box(2, 0, 3, 2), {}}}, Face{{b}, {box(10, 0, 11, 1), {}}}));
}

TEST(Faces, SumToWhatIsCovered) {
  for (std::uint64_t seed = 0; seed < cases(200); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    Map map;
    std::vector<Expression> all;
    for (int i = 0; i < 4; ++i) {
      Ring ring;
      for (int k = 0; k < 5; ++k)
        ring.push_back({static_cast<double>(random() % 9), static_cast<double>(random() % 9)});
      all.emplace_back(map.add(std::to_string(i), {ring}));
    }
    for (std::uint32_t k = 1; k <= 4; ++k) {
      ExactArea sum;
      for (const Face& face : faces(map.overlay))
        if (face.layers.size() == k) sum += area(face.polygon);
      ASSERT_EQ(sum, map.overlay.area(map.overlay.watch(exactly(k, all))));
    }
  }
}

TEST(Faces, APolygonCutByLinesFallsIntoParts) {
  Map map;
  const LayerId park = map.add("park", {box(0, 0, 8, 4), box(5, 1, 7, 3)});
  const LayerId roads = map.overlay.add_layer("roads");
  const ResultId result = map.overlay.watch(park);
  const std::vector<RingId> lines{
      map.overlay.insert(roads, std::vector<Point>{{2, -1}, {2, 5}}, open),
      map.overlay.insert(roads, std::vector<Point>{{1, 1}, {1, 2}}, open),   // cuts nothing off
      map.overlay.insert(roads, std::vector<Point>{{5, 2}, {2, 2}}, open)};  // nor does this
  EXPECT_EQ(parts_between(map.overlay, result, std::span(lines).first(2)).size(), 2U);
  EXPECT_EQ(parts_between(map.overlay, result, lines).size(), 2U);
  const std::vector<RingId> through{
      lines[0], lines[2], map.overlay.insert(roads, std::vector<Point>{{7, 2}, {9, 2}}, open)};
  const MultiPolygon parts = parts_between(map.overlay, result, through);
  ASSERT_EQ(parts.size(), 3U);
  EXPECT_EQ(area(parts), map.overlay.area(result));
  for (const Polygon& part : parts) EXPECT_THAT(part.holes, IsEmpty());
}

TEST(Cut, ALineFallsIntoPiecesWithTheirOwners) {
  Map map;
  const LayerId a = map.add("a", {box(0, 0, 4, 4)});
  const LayerId b = map.add("b", {box(4, 0, 8, 4)});
  const LayerId rivers = map.overlay.add_layer("rivers");
  const RingId river = map.overlay.insert(
      rivers, std::vector<Point>{{-1, 2}, {3, 2}, {4, 2}, {4, 3}, {6, 3}, {6, 9}}, open);
  const auto all = pieces(map.overlay, river);
  ASSERT_EQ(all.size(), 5U);
  EXPECT_EQ(all[0], (LinePiece{{{-1, 2}, {0, 2}}, {}, 1}));
  EXPECT_EQ(all[1], (LinePiece{{{0, 2}, {3, 2}, {4, 2}}, {{a}, {}}, 4}));
  EXPECT_EQ(all[2], (LinePiece{{{4, 2}, {4, 3}}, {{}, {a, b}}, 1}));
  EXPECT_EQ(all[3], (LinePiece{{{4, 3}, {6, 3}, {6, 4}}, {{b}, {}}, 3}));
  EXPECT_EQ(all[4], (LinePiece{{{6, 4}, {6, 9}}, {}, 5}));
  const auto sums = lengths(all);
  ASSERT_EQ(sums.size(), 4U);
  EXPECT_EQ(sums[0], (std::pair<Cover, double>{{}, 6}));
  map.overlay.translate(b, {100, 0});
  EXPECT_EQ(pieces(map.overlay, river).size(), 4U);
}

TEST(Cut, LengthsSumToTheLines) {
  for (std::uint64_t seed = 0; seed < cases(200); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> coordinate(0, 9);
    const auto points = [&](std::size_t count) {
      std::vector<Point> result(count);
      for (Point& p : result) p = {coordinate(random), coordinate(random)};
      return result;
    };
    Map map;
    for (int i = 0; i < 6; ++i) map.add(std::to_string(i), {points(5)});
    const std::vector<Point> line = points(12);
    const LayerId rivers = map.overlay.add_layer("rivers");
    double length = 0;
    for (std::size_t i = 1; i < line.size(); ++i)
      length += std::hypot(line[i].x - line[i - 1].x, line[i].y - line[i - 1].y);
    double sum = 0;
    const auto all = pieces(map.overlay, map.overlay.insert(rivers, line, open));
    for (const LinePiece& piece : all) sum += piece.length;
    EXPECT_NEAR(sum, length, 1e-12 * length);
    for (std::size_t i = 1; i < all.size(); ++i) {
      EXPECT_EQ(all[i].points.front(), all[i - 1].points.back());
      EXPECT_NE(all[i].cover, all[i - 1].cover);
    }
  }
}

}  // namespace
}  // namespace loft::overlay
