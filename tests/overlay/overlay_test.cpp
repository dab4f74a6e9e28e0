// SPDX-License-Identifier: MIT
#include "overlay/overlay.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <limits>
#include <thread>
#include <utility>
#include <vector>

#include "tests/overlay/boxes.h"

namespace loft::overlay {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// Two operands, a ring each or more.
struct Two {
  Overlay overlay;
  LayerId a = overlay.add_layer("a");
  LayerId b = overlay.add_layer("b");

  Two(const std::vector<Ring>& of_a, const std::vector<Ring>& of_b) {
    for (const Ring& ring : of_a) overlay.insert(a, ring);
    for (const Ring& ring : of_b) overlay.insert(b, ring);
  }

  MultiPolygon polygons(const Expression& what) { return overlay.polygons(overlay.watch(what)); }
  double area(const Expression& what) { return overlay.area(overlay.watch(what)).to_double(); }
};

// Small cases that others have reported, with answers in rational arithmetic.

TEST(OverlayReported, AnOperandAlongTwoSidesOfTheOther) {  // w8r/martinez#81
  Two two({{{0, 0}, {2, 2}, {4, 2}, {2, 0}}}, {{{1, 0}, {2, 1}, {3, 1}, {2, 0}}});
  EXPECT_THAT(two.polygons(two.a - Expression(two.b)),
              ElementsAre(Polygon{{{0, 0}, {1, 0}, {2, 1}, {3, 1}, {4, 2}, {2, 2}}, {}}));
  EXPECT_EQ(two.area(two.a - Expression(two.b)), 3);
  EXPECT_EQ(two.area(two.a & Expression(two.b)), 1);
  EXPECT_EQ(two.area(two.a | Expression(two.b)), 4);
}

TEST(OverlayReported, OnePolygonWithTwoHoles) {  // AngusJohnson/Clipper2#638
  Two two({{{0, 0},
            {1e5, 0},
            {1e5, 1e5},
            {2e5, 1e5},
            {2e5, 0},
            {3e5, 0},
            {3e5, 1e5},
            {4e5, 1e5},
            {4e5, 0},
            {5e5, 0},
            {5e5, 2e5},
            {0, 2e5}}},
          {{{0, 0}, {0, -1e5}, {5.5e5, -1e5}, {5.5e5, 0}}});
  const MultiPolygon both = two.polygons(two.a | Expression(two.b));
  ASSERT_EQ(both.size(), 1U);
  ASSERT_EQ(both[0].holes.size(), 2U);
  for (const Ring& hole : both[0].holes) EXPECT_EQ(area(hole).to_double(), -1e10);
  EXPECT_EQ(area(both).to_double(), 1.35e11);
}

TEST(OverlayReported, ASpikeHardlyInside) {  // locationtech/jts#798
  Two two(
      {{{66697.40120137333, 185279.95469107336}, {66698.375, 185273.625}, {66697.375, 185280.125}}},
      {square(66690, 185260, 20)});
  const ResultId both = two.overlay.watch(two.a & Expression(two.b));
  const ResultId either = two.overlay.watch(two.a | Expression(two.b));
  const ResultId a = two.overlay.watch(two.a);
  const ResultId b = two.overlay.watch(two.b);
  EXPECT_NEAR(two.overlay.area(both).to_double(), 3.5866301107e-12, 1e-9);
  EXPECT_NEAR(two.overlay.area(either).to_double(), 400.00000000000006, 1e-9);
  EXPECT_EQ(two.overlay.area(both) + two.overlay.area(either),
            two.overlay.area(a) + two.overlay.area(b));
}

TEST(OverlayReported, AHoleThatOpensToTheOutside) {  // mfogel/polygon-clipping#139
  Two two(
      {{{0, 56}, {4, 56}, {4, 60}, {0, 60}}, {{0.5, 56.4}, {0.5, 56.6}, {1.5, 56.6}, {1.5, 56.4}}},
      {{{2.3000000000000003, 55.6},
        {0.7000000000000001, 55.6},
        {0.6999999999999998, 56.4},
        {2.3, 56.4}}});
  const MultiPolygon rest = two.polygons(two.a - Expression(two.b));
  ASSERT_EQ(rest.size(), 1U);
  EXPECT_THAT(rest[0].holes, IsEmpty());
  EXPECT_NEAR(area(rest).to_double(), 15.16, 1e-13);
  EXPECT_NEAR(two.area(two.a & Expression(two.b)), 0.64, 1e-13);
}

TEST(OverlayReported, NeighboursWhoseSidesOverlap) {  // libgeos/geos#889
  Two two({{{0, 0}, {0, 1}, {1, 0}}}, {{{0, 0}, {2, 0}, {0, -2}}});
  const MultiPolygon both = two.polygons(two.a | Expression(two.b));
  EXPECT_THAT(both, ElementsAre(Polygon{{{0, -2}, {2, 0}, {1, 0}, {0, 1}, {0, 0}}, {}}));
  EXPECT_EQ(area(both).to_double(), 2.5);
}

TEST(OverlayReported, ARingThatTouchesItself) {  // CGAL/cgal#3697
  Two two({{{2, 1}, {3, 0}, {5, 4}, {2, 1}, {1, 3}, {0, 2}}}, {});
  const MultiPolygon parts = two.polygons(two.a);
  EXPECT_THAT(parts, ElementsAre(Polygon{{{0, 2}, {2, 1}, {1, 3}}, {}},
                                 Polygon{{{2, 1}, {3, 0}, {5, 4}}, {}}));
  EXPECT_EQ(area(parts).to_double(), 4.5);
}

TEST(OverlayReported, AnOperandAcrossACorner) {  // Turfjs/turf#2865
  Two two({{{28, 0}, {40, 0}, {40, 40}, {29, 40}}}, {{{40, 29}, {29, 29}, {29, 40}, {40, 40}}});
  const MultiPolygon rest = two.polygons(two.a - Expression(two.b));
  EXPECT_THAT(rest, ElementsAre(Polygon{{{28, 0}, {40, 0}, {40, 29}, {29, 29}, {29, 40}}, {}}));
  EXPECT_EQ(area(rest).to_double(), 339);
}

TEST(OverlayReported, PointsOnSharedBorders) {  // rapidsai/cuspatial#744
  Two two({{{-1, -1}, {0, -1}, {0, 1}, {-1, 1}}}, {{{0, -1}, {1, -1}, {1, 1}, {0, 1}}});
  EXPECT_EQ(two.overlay.cover(Point{0, 0}), (Cover{{}, {two.a, two.b}}));
  EXPECT_EQ(two.overlay.cover(Point{0, 1}), (Cover{{}, {two.a, two.b}}));
  EXPECT_EQ(two.overlay.cover(Point{-0.5, 1}), (Cover{{}, {two.a}}));
  EXPECT_EQ(two.overlay.cover(Point{-0.5, 0.5}), (Cover{{two.a}, {}}));
  EXPECT_EQ(two.overlay.cover(Point{5, 5}), Cover());
}

// Polygons.

TEST(Overlay, SplitsWhatTouchesInAPoint) {
  Two two({square(0, 0, 2), square(2, 2, 2)}, {});
  EXPECT_THAT(two.polygons(two.a),
              ElementsAre(Polygon{square(0, 0, 2), {}}, Polygon{square(2, 2, 2), {}}));
}

TEST(Overlay, AHoleThatTouchesTheOutlineIsAHole) {
  Two two({square(0, 0, 4), {{0, 2}, {2, 1}, {2, 3}}}, {});
  const MultiPolygon parts = two.polygons(two.a);
  ASSERT_EQ(parts.size(), 1U);
  EXPECT_EQ(parts[0].outer, square(0, 0, 4));
  EXPECT_THAT(parts[0].holes, ElementsAre(Ring{{0, 2}, {2, 3}, {2, 1}}));
}

TEST(Overlay, HolesGoToTheSmallestPolygonAroundThem) {
  Two two({square(0, 0, 100), square(10, 10, 80), square(20, 20, 60), square(30, 30, 5),
           square(40, 40, 5), square(50, 50, 28), square(55, 55, 20), square(92, 50, 4)},
          {});
  const MultiPolygon parts = two.polygons(two.a);
  ASSERT_EQ(parts.size(), 3U);
  EXPECT_EQ(parts[0].holes.size(), 2U);
  EXPECT_EQ(parts[1].holes.size(), 3U);
  EXPECT_EQ(parts[2].outer, square(55, 55, 20));
}

TEST(Overlay, TwoHolesThatTouchCutAPolygonInTwo) {
  Two two({square(0, 0, 6)}, {{{0, 3}, {3, 2}, {3, 4}}, {{3, 2}, {6, 3}, {3, 4}}});
  EXPECT_EQ(two.polygons(two.a - Expression(two.b)).size(), 2U);
}

TEST(Overlay, LeavesOutWhatIsStraightAlongOneSegment) {
  Two two({square(0, 0, 4)}, {{{-1, 1}, {5, 1}, {5, 3}, {-1, 3}}});
  const ResultId a = two.overlay.watch(two.a);
  EXPECT_EQ(two.overlay.polygons(a)[0].outer.size(), 4U);
  EXPECT_EQ(two.overlay.polygons(a, Vertices::all)[0].outer.size(), 8U);
}

TEST(Overlay, DirectionAndStartOfRingsDoNotMatter) {
  const Ring ring{{0, 0}, {5, 1}, {4, 6}, {2, 2}, {-1, 5}};
  Two two({ring}, {square(1, 1, 3)});
  const MultiPolygon wanted = two.polygons(two.a ^ Expression(two.b));
  for (std::size_t start = 0; start < 2 * ring.size(); ++start) {
    Ring other = ring;
    std::rotate(other.begin(), other.begin() + static_cast<std::ptrdiff_t>(start % ring.size()),
                other.end());
    if (start >= ring.size()) std::ranges::reverse(other);
    Two again({other}, {square(1, 1, 3)});
    EXPECT_EQ(again.polygons(again.a ^ Expression(again.b)), wanted);
  }
}

// Edits.

TEST(Overlay, TellsWhatAMoveDid) {
  Two two({square(0, 0, 2)}, {square(1, 0, 2)});
  Overlay& overlay = two.overlay;
  const ResultId both = overlay.watch(two.a & Expression(two.b));
  EXPECT_EQ(overlay.change(both).come.size(), overlay.border(both).size());
  overlay.translate(two.b, {0.5, 0});
  EXPECT_EQ(overlay.area(both).to_double(), 1);
  EXPECT_EQ(overlay.change(both).area.to_double(), -1);
  EXPECT_THAT(overlay.changed_rings(both), ElementsAre(Ring{{1.5, 0}, {2, 0}, {2, 2}, {1.5, 2}}));
  overlay.translate(two.b, {100, 0});
  EXPECT_EQ(overlay.area(both).sign(), 0);
  EXPECT_THAT(overlay.polygons(both), IsEmpty());
  overlay.translate(two.b, {1, 0});
  EXPECT_TRUE(overlay.change(both).is_empty());
}

TEST(Overlay, TellsWhatAStepDidAlthoughNothingIsMadeAnew) {
  Overlay overlay;
  const LayerId a = overlay.add_layer("a");
  const LayerId b = overlay.add_layer("b");
  overlay.insert(a, box(0, 0, 10, 10));
  const RingId moving = overlay.insert(b, box(3, 3, 6, 7));
  const ResultId both = overlay.watch(Expression(a) & b);
  const ResultId rest = overlay.watch(Expression(a) - b);
  for (const double by : {0x1p-20, -0x1p-19}) {
    overlay.translate(moving, {by, 0});
    EXPECT_EQ(overlay.triangulation().changes().moved, overlay.triangulation().changes().made);
    EXPECT_EQ(overlay.change(both).gone.size(), 4U);
    EXPECT_EQ(overlay.change(both).come.size(), 4U);
    EXPECT_EQ(overlay.change(rest).come.size(), 4U) << "and not the frame";
    EXPECT_EQ(overlay.change(both).area.sign(), 0);
    EXPECT_EQ(overlay.area(both).to_double(), 12);
    EXPECT_EQ(overlay.area(rest).to_double(), 88);
  }
  EXPECT_EQ(overlay.polygons(both), (MultiPolygon{{box(3 - 0x1p-20, 3, 6 - 0x1p-20, 7), {}}}));
}

TEST(Overlay, ABatchIsOneChange) {
  Two two({square(0, 0, 2), square(10, 0, 2)}, {});
  Overlay& overlay = two.overlay;
  const ResultId a = overlay.watch(two.a);
  overlay.begin_batch();
  for (const RingId ring : std::vector(overlay.rings(two.a).begin(), overlay.rings(two.a).end()))
    overlay.translate(ring, {0, 1});
  overlay.insert(two.a, square(20, 0, 2));
  EXPECT_EQ(overlay.area(a).to_double(), 8);
  overlay.end_batch();
  EXPECT_EQ(overlay.change(a).area.to_double(), 4);
  EXPECT_EQ(overlay.polygons(a).size(), 3U);
  overlay.clear(two.a);
  EXPECT_EQ(overlay.change(a).area.to_double(), -12);
  EXPECT_THAT(overlay.rings(two.a), IsEmpty());
}

TEST(Overlay, WhatIsWatchedFromAmidABatchIsRightAfterIt) {
  for (const bool is_watched_before : {false, true}) {
    Two two({square(0, 0, 8), square(10, 0, 2)}, {square(1, 1, 3)});
    Overlay& overlay = two.overlay;
    const Expression both = Expression(two.a) | two.b;
    if (is_watched_before) (void)overlay.watch(both);
    overlay.begin_batch();
    overlay.remove(overlay.rings(two.a)[1]);
    for (const double x : {20.0, 24.0, 28.0}) overlay.insert(two.a, square(x, 0, 2));
    const ResultId result = overlay.watch(both);
    overlay.insert(two.b, square(21, 1, 4));
    overlay.end_batch();
    const ResultId fresh = overlay.watch(both);
    EXPECT_EQ(overlay.polygons(result), overlay.polygons(fresh));
    EXPECT_EQ(overlay.area(result).to_double(), overlay.area(fresh).to_double());
    EXPECT_EQ(overlay.area(result).to_double(), 64 + 8 + 4 + 16 - 2);
  }
}

TEST(Overlay, ALayerTurnsAsAWhole) {
  Two two({square(0, 0, 2), square(4, 0, 2)}, {});
  const ResultId a = two.overlay.watch(two.a);
  two.overlay.transform(two.a, {.xx = 0, .xy = -1, .x0 = 0, .yx = 1, .yy = 0, .y0 = 0});
  EXPECT_THAT(two.overlay.polygons(a),
              ElementsAre(Polygon{square(-2, 0, 2), {}}, Polygon{square(-2, 4, 2), {}}));
}

TEST(Overlay, AnotherExpressionForAResult) {
  Two two({square(0, 0, 4)}, {square(1, 1, 2)});
  Overlay& overlay = two.overlay;
  const Expression a = two.a;
  const Expression b = two.b;
  const ResultId result = overlay.watch(a - b);
  EXPECT_EQ(overlay.area(result).to_double(), 12);
  overlay.set(result, a | b);
  EXPECT_EQ(overlay.area(result).to_double(), 16);
  EXPECT_EQ(overlay.change(result).gone.size(), 4U);
  EXPECT_THAT(overlay.change(result).come, IsEmpty());
  EXPECT_EQ(overlay.expression(result), (a | b));
  EXPECT_THAT(overlay.polygons(result), ElementsAre(Polygon{square(0, 0, 4), {}}));
  overlay.unwatch(result);
  EXPECT_THROW((void)overlay.area(result), std::invalid_argument);
  EXPECT_EQ(overlay.watch(b), result);  // ids of removed things are used again
}

TEST(Overlay, DuplicatesAndSpikesEncloseNothingOrTheSame) {
  Two two({square(0, 0, 2), {{5, 0}, {7, 0}}, {{5, 5}}, {{8, 0}, {9, 0}, {8, 0}, {9, 0}}}, {});
  const RingId line = two.overlay.insert(two.a, std::vector<Point>{{-1, 1}, {3, 1}}, open);
  EXPECT_EQ(two.area(two.a), 4);
  EXPECT_EQ(two.overlay.rings_without_inside().size(), 3U);
  EXPECT_EQ(two.overlay.layer(line), two.a);
  Overlay& overlay = two.overlay;
  const LayerId twice = overlay.add_layer("twice", FillRule::nonzero);
  overlay.insert(twice, square(0, 0, 2));
  overlay.insert(twice, square(0, 0, 2));
  EXPECT_EQ(overlay.area(overlay.watch(twice)).to_double(), 4);
  overlay.insert(two.a, square(0, 0, 2));
  EXPECT_EQ(two.area(two.a), 0);  // even-odd
}

TEST(Overlay, RefusesAndSaysWhere) {
  Two two({square(0, 0, 2)}, {});
  Overlay& overlay = two.overlay;
  const ResultId a = overlay.watch(two.a);
  const auto expect_refused = [](auto edit, const char* what) {
    try {
      edit();
      FAIL() << what;
    } catch (const std::invalid_argument& error) {
      EXPECT_THAT(error.what(), HasSubstr(what));
    }
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Point> bad{{0, 0}, {1, nan}, {2, 2}};
  expect_refused([&] { overlay.insert(two.a, bad); }, "layer 'a', ring 1: point 1 (1, nan)");
  expect_refused([&] { overlay.insert(two.a, std::vector<Point>()); }, "has no point");
  expect_refused([&] { overlay.insert(LayerId(9), square(0, 0, 1)); }, "no such layer");
  expect_refused([&] { overlay.move(RingId(9), square(0, 0, 1)); }, "no such ring");
  expect_refused([&] { overlay.translate(two.a, {1e80, 0}); }, "not usable");
  expect_refused([&] { overlay.watch(~Expression(two.a)); }, "without bounds");
  expect_refused([&] { overlay.watch(LayerId(7)); }, "a layer that is not there");
  expect_refused([&] { overlay.set(a, ~Expression(two.a)); }, "without bounds");
  expect_refused([&] { overlay.clear(LayerId(9)); }, "no such layer");
  EXPECT_EQ(overlay.area(a).to_double(), 4);
  overlay.translate(two.a, {1, 0});
  EXPECT_EQ(overlay.polygons(a)[0].outer, square(1, 0, 2));
}

TEST(Overlay, NothingIsNoProblem) {
  Overlay overlay;
  const LayerId a = overlay.add_layer("a");
  const ResultId result = overlay.watch(a);
  EXPECT_EQ(overlay.area(result).sign(), 0);
  EXPECT_THAT(overlay.polygons(result), IsEmpty());
  EXPECT_EQ(overlay.cover(Point{0, 0}), Cover());
  overlay.insert(a, std::vector<Point>{{1, 1}});
  EXPECT_EQ(overlay.cover(Point{1, 1}), Cover());
  overlay.clear(a);
  Overlay other = std::move(overlay);
  other.insert(a, square(0, 0, 1));
  EXPECT_EQ(other.area(result).to_double(), 1);
}

TEST(Overlay, TheBoundOfTheErrorHolds) {
  Two two({{{0, 0}, {7, 1}, {3, 5}}}, {{{1, -1}, {6, 2}, {2, 9}}});
  const double bound = two.overlay.area_error_bound();
  EXPECT_GT(bound, 0);
  EXPECT_LT(bound, 1e-13);
  Two exact({square(0, 0, 2)}, {square(1, 1, 2)});
  EXPECT_EQ(exact.overlay.area_error_bound(), 0);
}

TEST(Overlay, IsReadBySeveralThreadsAtOnce) {
  Two two({square(0, 0, 8), square(3, 3, 9)}, {square(2, 1, 8)});
  const Overlay& overlay = two.overlay;
  const ResultId both = two.overlay.watch(two.a & Expression(two.b));
  const MultiPolygon wanted = overlay.polygons(both);
  const Cover middle = overlay.cover(Point{2.5, 2.5});
  std::vector<std::thread> threads;
  std::atomic<int> right = 0;
  for (int i = 0; i < 4; ++i)
    threads.emplace_back([&] {
      for (int k = 0; k < 50; ++k)
        right +=
            overlay.polygons(both) == wanted && overlay.cover(Point{2.5, 2.5}) == middle ? 1 : 0;
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(right, 200);
}

TEST(Overlay, ForgetsWindingsThatAreNowhere) {
  Overlay overlay;
  std::vector<LayerId> layers;
  std::vector<RingId> rings;
  for (int i = 0; i < 40; ++i) {
    layers.push_back(overlay.add_layer(std::to_string(i)));
    rings.push_back(overlay.insert(layers.back(), square(i, i, 30)));
  }
  const ResultId most =
      overlay.watch(at_least(3, std::vector<Expression>(layers.begin(), layers.end())));
  std::size_t largest = 0;
  for (int i = 0; i < 4000; ++i) {
    overlay.translate(rings[static_cast<std::size_t>(i * 7) % rings.size()],
                      {((i * 37) % 11) - 5.0, ((i * 53) % 11) - 5.0});
    largest = std::max(largest, overlay.cover_bound());
  }
  EXPECT_LT(largest, 20'000U);
  const MultiPolygon kept = overlay.polygons(most);
  EXPECT_EQ(overlay.polygons(overlay.watch(overlay.expression(most))), kept);
}

}  // namespace
}  // namespace loft::overlay
