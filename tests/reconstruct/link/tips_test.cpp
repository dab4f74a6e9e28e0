// SPDX-License-Identifier: MIT
// Parts that end in a point or a line: apexes and ridges.
#include "reconstruct/link/tips.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "reconstruct/clean/cleaning.h"
#include "reconstruct/out_of_core.h"
#include "reconstruct/reconstruct.h"
#include "reconstruct/reconstruction.h"
#include "tests/reconstruct/live/edit_script.h"
#include "tests/reconstruct/solid.h"
#include "tests/reconstruct/stacks.h"

namespace loft {
namespace {

using cdt::Point;
using stacks::circle;
using stacks::square;

Contour contour(std::vector<Point> points, std::string label = "") {
  return {std::move(points), std::move(label)};
}

Contour rectangle(double width, double depth) {
  return contour({{0, 0}, {width, 0}, {width, depth}, {0, depth}});
}

/// Of a valid solid without anything to report.
Measures of_solid(const std::vector<Slice>& slices, const Options& options = {}) {
  const Reconstructed made = reconstruct(slices, options);
  EXPECT_TRUE(made.repairs.empty()) << describe(made.repairs.front());
  EXPECT_EQ(solids::faults(made.surface), "");
  return measure(made.surface);
}

std::vector<Slice> upside_down(std::vector<Slice> slices) {
  for (Slice& slice : slices) slice.z = -slice.z;
  return slices;
}

/// In every way that a stack can stand.
void expect_volume(const std::vector<Slice>& slices, double volume) {
  EXPECT_NEAR(of_solid(slices).volume, volume, 1e-12 * volume);
  EXPECT_NEAR(of_solid(upside_down(slices)).volume, volume, 1e-12 * volume);
  for (const double angle : {0.3, 1.0, 2.5}) {
    for (const double mirrored : {1.0, -1.0}) {
      std::vector<Slice> other = slices;
      for (Slice& slice : other)
        for (Contour& one : slice.contours)
          for (Point& p : one.points)
            p = {mirrored * (p.x * std::cos(angle) - p.y * std::sin(angle)) + 0.1,
                 p.x * std::sin(angle) + p.y * std::cos(angle) - 0.7};
      EXPECT_NEAR(of_solid(other).volume, volume, 1e-9 * volume) << angle << ' ' << mirrored;
    }
  }
}

TEST(Tips, APointAboveASquareMakesAPyramid) {
  expect_volume({{0, {square(5)}}, {10, {contour({{0, 0}})}}}, 1000.0 / 3);
  EXPECT_EQ(of_solid({{0, {square(5)}}, {10, {contour({{0, 0}})}}}).faces, 6U);
}

TEST(Tips, PointsAtBothEndsMakeADoublePyramid) {
  const std::vector<Slice> slices{
      {0, {contour({{0, 0}})}}, {5, {square(5)}}, {10, {contour({{0, 0}})}}};
  expect_volume(slices, 1000.0 / 3);
  const Measures made = of_solid(slices);
  EXPECT_EQ(made.faces, 8U);
  EXPECT_EQ(made.vertices, 6U);
}

TEST(Tips, AnApexIsAVertexThatKnowsItsContour) {
  const Surface surface =
      reconstruct(std::vector<Slice>{{0, {square(5)}}, {10, {contour({{1, 2}})}}}).surface;
  int found = 0;
  for (const auto v : surface.vertices())
    if (surface.data(v).origin == Origin{VertexKind::contour, 1, 0, 0}) {
      ++found;
      EXPECT_EQ(surface.point(v)[0], 1);
      EXPECT_EQ(surface.point(v)[1], 2);
      EXPECT_EQ(surface.point(v)[2], 10);
    }
  EXPECT_EQ(found, 1);
}

TEST(Tips, AnApexMayBeAnywhereAboveItsPart) {
  for (const Point apex : {Point{4.9, 4.9}, Point{-3, 1}, Point{5, 0}, Point{5, 5}, Point{-5, 2}})
    expect_volume({{0, {square(5)}}, {10, {contour({apex})}}}, 1000.0 / 3);
}

/// Many points on long sides: those beside a corner are nearer to each other than to the apex.
Contour finely_sided(double width, double depth, int pieces) {
  Contour fine;
  const Contour coarse = rectangle(width, depth);
  for (std::size_t i = 0; i < 4; ++i)
    for (int k = 0; k < pieces; ++k) {
      const Point p = coarse.points[i];
      const Point q = coarse.points[(i + 1) % 4];
      const double share = static_cast<double>(k) / pieces;
      fine.points.push_back({p.x + share * (q.x - p.x), p.y + share * (q.y - p.y)});
    }
  return fine;
}

TEST(Tips, AConeIsExactWhateverTheOutlineSees) {
  expect_volume({{0, {finely_sided(64, 2, 32)}}, {3, {contour({{32, 1}})}}}, 128);
  expect_volume({{0, {finely_sided(64, 2, 32)}}, {3, {contour({{1, 0.5}})}}}, 128);
  const std::vector<Slice> star{
      {0, {contour({{10, 0}, {1, 1}, {0, 10}, {-1, 1}, {-10, 0}, {-1, -1}, {0, -10}, {1, -1}})}},
      {3, {contour({{0, 0}})}}};
  expect_volume(star, 40);
}

TEST(Tips, ALineAboveARectangleMakesATent) {
  // Hipped: two pyramids of half the depth at the ends, a prism between.
  expect_volume({{0, {rectangle(10, 6)}}, {10, {contour({{2, 3}, {8, 3}})}}}, 180 + 80);
  expect_volume({{0, {finely_sided(10, 6, 16)}}, {10, {contour({{2, 3}, {8, 3}})}}}, 260);
  EXPECT_EQ(of_solid({{0, {rectangle(10, 6)}}, {10, {contour({{2, 3}, {8, 3}})}}}).faces, 8U);
}

TEST(Tips, ALineFromSideToSideMakesAWedge) {
  expect_volume({{0, {rectangle(10, 6)}}, {10, {contour({{0, 3}, {10, 3}})}}}, 300);
  expect_volume({{0, {rectangle(10, 6)}}, {10, {contour({{0, 6}, {10, 6}})}}}, 300);
}

TEST(Tips, ALineMayBeWrittenInManyWays) {
  const std::vector<std::vector<Point>> ways{{{2, 3}, {8, 3}},
                                             {{8, 3}, {2, 3}},
                                             {{2, 3}, {8, 3}, {2, 3}},
                                             {{2, 3}, {4, 3}, {8, 3}},
                                             {{4, 3}, {2, 3}, {8, 3}, {6, 3}, {4, 3}},
                                             {{2, 3}, {2, 3}, {8, 3}}};
  for (const auto& way : ways)
    EXPECT_NEAR(of_solid({{0, {rectangle(10, 6)}}, {10, {contour(way)}}}).volume, 260, 1e-9);
  for (const auto& way : std::vector<std::vector<Point>>{{{5, 3}}, {{5, 3}, {5, 3}, {5, 3}}})
    EXPECT_NEAR(of_solid({{0, {rectangle(10, 6)}}, {10, {contour(way)}}}).volume, 200, 1e-9);
}

TEST(Tips, LinesThatShareAnEndAreOneRidge) {
  const Slice roof{10, {contour({{2, 3}, {5, 3}}), contour({{5, 3}, {5, 9}})}};
  const Measures made =
      of_solid({{0, {contour({{0, 0}, {8, 0}, {8, 10}, {2, 10}, {2, 6}, {0, 6}})}}, roof});
  EXPECT_EQ(made.components, 1U);
  EXPECT_EQ(made.genus, 0);
  EXPECT_GT(made.volume, 300);
}

TEST(Tips, AnOutlineWithARecessStaysWithinItself) {
  const std::vector<Slice> slices{
      {0, {contour({{0, 0}, {10, 0}, {10, 2}, {2, 2}, {2, 10}, {0, 10}}), square(1, {8, 6})}},
      {10, {contour({{1, 9}}), square(1, {8, 6})}}};
  const Measures made = of_solid(slices);
  EXPECT_EQ(made.components, 2U);
  EXPECT_GT(made.volume, 40 + 36 * 10 * 0.15);
  EXPECT_LT(made.volume, 40 + 36 * 10 * 0.4);
}

TEST(Tips, APartWithAHoleEndsInAPointWithIt) {
  const Measures made = of_solid({{0, {circle(24, 6), circle(16, 3)}}, {4, {contour({{4.5, 0}})}}});
  EXPECT_EQ(made.components, 1U);
  EXPECT_EQ(made.genus, 1);  // the hole stays open
}

TEST(Tips, OfTwoPartsTheOneThatWouldEndDoes) {
  const std::vector<Slice> slices{
      {0, {square(2), square(2, {9, 0})}},
      {3, {square(2), square(2, {9, 0})}},
      {6, {square(2), contour({{9, 0}})}},
      {9, {square(2)}},
  };
  const Measures made = of_solid(slices);
  EXPECT_EQ(made.components, 2U);
  EXPECT_NEAR(made.volume, 16 * 9 + 16 * 3 + 16, 1e-12);
}

TEST(Tips, AStrayPointChangesNothingWhereThePartGoesOn) {
  const std::vector<Slice> plain{{0, {square(9)}}, {3, {square(2)}}, {6, {square(9)}}};
  std::vector<Slice> stray = plain;
  stray[1].contours.push_back(contour({{5, 5}}));
  stray[1].contours.push_back(contour({{1, 1}, {0, 1}}));
  const Reconstructed made = reconstruct(stray);
  ASSERT_EQ(made.repairs.size(), 2U);
  EXPECT_EQ(describe(made.repairs[0]),
            "slice 1 (z = 3) contour 2 near (0, 1): is a line inside an "
            "outline of its slice, or at one; dropped");
  EXPECT_EQ(describe(made.repairs[1]),
            "slice 1 (z = 3) contour 1 near (5, 5): is a point that no part ends in: none covers "
            "it that does not go on in this slice; dropped");
  const Surface expected = reconstruct(plain).surface;
  EXPECT_EQ(made.surface.n_faces(), expected.n_faces());
  EXPECT_NEAR(measure(made.surface).volume, measure(expected).volume, 1e-9);
}

TEST(Tips, APointThatNoPartCoversIsNamedAndDropped) {
  const std::vector<Slice> slices{{0, {square(2)}}, {1, {square(2)}}, {2, {contour({{3, 0}})}}};
  const Reconstructed made = reconstruct(slices);
  ASSERT_EQ(made.repairs.size(), 1U);
  EXPECT_EQ(made.repairs[0].kind, DefectKind::too_few_points);
  EXPECT_EQ(made.repairs[0].slice, 2U);
  auto without = slices;
  without[2].contours.clear();
  EXPECT_EQ(to_mesh(made.surface), to_mesh(reconstruct(without).surface));
}

TEST(Tips, ALineIsCoveredAsAWholeOrNotAtAll) {
  const Reconstructed made = reconstruct(
      std::vector<Slice>{{0, {square(2)}}, {1, {square(2)}}, {2, {contour({{-1, 0}, {3, 0}})}}});
  ASSERT_EQ(made.repairs.size(), 1U);
  EXPECT_EQ(solids::faults(made.surface), "");
}

TEST(Tips, PointsAloneMakeNothing) {
  const std::vector<Slice> slices{{0, {contour({{0, 0}})}}, {1, {contour({{0, 0}, {1, 0}})}}};
  EXPECT_THROW((void)reconstruct(slices), InputError);
}

TEST(Tips, APinchTouchesItselfInOneVertexOfEach) {
  const std::vector<Slice> slices{{0, {square(5)}}, {10, {contour({{0, 0}})}}, {20, {square(5)}}};
  expect_volume(slices, 2000.0 / 3);
  EXPECT_EQ(of_solid(slices).components, 2U);
  const std::vector<Slice> crease{
      {0, {square(5)}}, {10, {contour({{-2, 0}, {2, 0}})}}, {20, {square(5)}}};
  expect_volume(crease, 800);
  EXPECT_EQ(of_solid(crease).components, 2U);
}

TEST(Tips, TwoPartsThatTouchMayShareAnApex) {
  std::vector<Slice> slices{{0, {square(1, {-1, -1}), square(1, {1, 1})}},
                            {3, {contour({{0, 0}})}}};
  const Measures made = of_solid(slices);
  EXPECT_NEAR(made.volume, 8, 1e-12);
  EXPECT_EQ(made.components, 2U);
}

TEST(Tips, APartMayEndInSeveral) {
  const Measures made =
      of_solid({{0, {rectangle(20, 6)}},
                {5, {contour({{3, 3}}), contour({{17, 3}}), contour({{9, 2}, {11, 2}})}}});
  EXPECT_EQ(made.components, 1U);
  EXPECT_GT(made.volume, 200);
  EXPECT_LT(made.volume, 600);
}

TEST(Tips, APointOfALabelIsOfThatLabel) {
  std::vector<Slice> slices{{0, {square(2), square(1, {9, 0})}},
                            {3, {square(2), contour({{9, 0}})}}};
  for (Slice& slice : slices) {
    slice.contours[0].label = "body";
    slice.contours[1].label = "horn";
  }
  EXPECT_NEAR(of_solid(slices, {.label = "horn"}).volume, 4, 1e-12);
  EXPECT_NEAR(of_solid(slices, {.label = "body"}).volume, 48, 1e-12);
}

TEST(Tips, EveryOptionTakesThem) {
  const std::vector<Slice> slices{{0, {contour({{0, 0}})}},
                                  {5, {circle(12, 5)}},
                                  {9, {circle(12, 4), circle(8, 2)}},
                                  {12, {contour({{2.7, 0}, {2.8, 1}})}}};
  for (const LinkRule link : {LinkRule::automatic, LinkRule::overlap, LinkRule::none})
    for (Options options :
         {Options{.smooth = true}, Options{.max_edge = 1}, Options{.simplify = 0.1},
          Options{.target_edge = 1}, Options{.cap = Cap::dome}}) {
      options.link = link;
      EXPECT_EQ(solids::faults(reconstruct(slices, options).surface), "");
    }
  const Surface open = reconstruct(slices, {.cap = Cap::open}).surface;
  EXPECT_EQ(solids::faults(open), "") << "both ends are points: there is nothing to cap";
}

TEST(Tips, AnOrderToLinkWhatEndsInOneIsRefused) {
  const std::vector<Slice> slices{{0, {square(2)}}, {3, {contour({{0, 0}}), square(2, {9, 0})}}};
  const Reconstructed made = reconstruct(
      slices, {.links = {{.from = {0, 0}, .to = {1, 1}, .is_link = true, .place = "here"}}});
  ASSERT_EQ(made.repairs.size(), 1U);
  EXPECT_EQ(made.repairs[0].kind, DefectKind::refused_link);
  EXPECT_EQ(solids::faults(made.surface), "");
}

TEST(Tips, AnOrderToLinkAPartWithItsPointIsMet) {
  const std::vector<Slice> slices{{0, {square(2)}},
                                  {3, {contour({{0, 0}}), contour({{9, 0}}), square(2, {20, 0})}}};
  const auto repairs = [&](std::uint32_t to) {
    return reconstruct(slices, {.links = {{.from = {0, 0}, .to = {1, to}}}}).repairs;
  };
  EXPECT_EQ(repairs(0).size(), 1U) << "the other point is dropped";
  ASSERT_EQ(repairs(1).size(), 2U);
  EXPECT_EQ(repairs(1)[0].kind, DefectKind::refused_link);
}

TEST(Tips, ReportsNameTheContourThatAPartEndsIn) {
  const std::vector<Slice> slices{{0, {square(2)}}, {3, {square(1, {9, 0}), contour({{0, 0}})}}};
  const auto slabs = reconstruct(slices, {.reports_slabs = true}).slabs;
  ASSERT_EQ(slabs.size(), 1U);
  ASSERT_EQ(slabs[0].links.size(), 2U);
  EXPECT_EQ(slabs[0].links[0].kind, LinkKind::death);
  EXPECT_EQ(slabs[0].links[0].upper, std::vector{(ContourId{1, 1})});
}

TEST(Tips, LinesThatCrossOrRepeatAreDroppedInAnyOrder) {
  std::vector<Contour> lines{contour({{2, 3}, {8, 3}}), contour({{5, 1}, {5, 5}}),
                             contour({{2, 3}, {8, 3}}), contour({{4, 3}}), contour({{2, 3}})};
  std::set<double> volumes;
  for (int turn = 0; turn < 5; ++turn) {
    const Reconstructed made =
        reconstruct(std::vector<Slice>{{0, {rectangle(10, 6)}}, {10, lines}});
    EXPECT_EQ(made.repairs.size(), 4U);
    EXPECT_EQ(solids::faults(made.surface), "");
    volumes.insert(measure(made.surface).volume);
    std::ranges::rotate(lines, lines.begin() + 1);
  }
  EXPECT_EQ(volumes.size(), 1U);
}

/// Slices of parts that end here and there, with points and lines about.
std::vector<Slice> random_tips(std::uint64_t seed, std::size_t count) {
  std::mt19937_64 random(seed);
  const bool on_grid = seed % 2 == 0;
  const auto share = [&] {
    return on_grid ? static_cast<double>(random() % 9) / 8
                   : static_cast<double>(random() % 1000) / 999;
  };
  const auto place = [&] { return Point{20 * share(), 20 * share()}; };
  std::vector<Slice> slices;
  for (std::size_t i = 0; i < count; ++i) {
    Slice& slice = slices.emplace_back(Slice{static_cast<double>(i), {}});
    for (std::size_t k = random() % 4; k > 0; --k) {
      const Point centre = place();
      if (random() % 2 == 0) {
        slice.contours.push_back(square(1 + 4 * share(), centre));
      } else {
        slice.contours.push_back(circle(3 + random() % 9, 1 + 5 * share(), centre, share()));
      }
    }
    for (std::size_t k = random() % 5; k > 0; --k) slice.contours.push_back(contour({place()}));
    for (std::size_t k = random() % 4; k > 0; --k) {
      const Point p = place();
      slice.contours.push_back(contour({p, {p.x + 2 * share(), p.y + 2 * share() - 1}}));
    }
  }
  return slices;
}

TEST(Tips, RandomStacksWithThemAreSolid) {
  std::size_t count = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    SCOPED_TRACE(seed);
    const auto slices = random_tips(seed, 5);
    for (std::size_t i = 0; i + 1 < slices.size(); ++i) {
      const auto region = [](const Slice& slice) {
        std::vector<Defect> repairs;
        std::vector<ContourSource> sources;
        for (std::uint32_t c = 0; c < slice.contours.size(); ++c)
          sources.push_back({slice.contours[c].points, 0, c});
        return clean(sources, slice.z, {}, repairs);
      };
      count += find_tips(region(slices[i]), region(slices[i + 1])).size();
    }
    Options options;
    options.cap = seed % 3 == 0 ? Cap::dome : Cap::flat;
    options.link = seed % 5 == 0 ? LinkRule::none : LinkRule::automatic;
    options.smooth = seed % 4 == 0;
    solids::expect_solid(slices, options);
  }
  EXPECT_GT(count, 100U);
}

TEST(Tips, OutOfCoreMakesTheSame) {
  struct Counter : SurfaceSink {
    void add_vertices(std::span<const SurfaceVertex> some) override { vertices += some.size(); }
    void add_faces(std::span<const SurfaceFace> some) override { faces += some.size(); }
    void end(const VertexNumbers&) override {}
    std::size_t vertices = 0;
    std::size_t faces = 0;
  };
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const auto slices = random_tips(seed, 7);
    SliceSource source;
    for (const Slice& slice : slices) source.slices.push_back({slice.z, point_count(slice)});
    source.read = [&](std::size_t i) { return slices[i]; };
    for (const Cap cap : {Cap::flat, Cap::dome}) {
      try {
        const Reconstructed whole = reconstruct(slices, {.cap = cap});
        Counter counter;
        const OutOfCoreReport report = reconstruct_out_of_core(source, {.cap = cap}, counter);
        EXPECT_EQ(counter.vertices, whole.surface.n_vertices()) << seed;
        EXPECT_EQ(counter.faces, whole.surface.n_faces()) << seed;
        EXPECT_NEAR(report.measures.volume, measure(whole.surface).volume, 1e-9) << seed;
        ASSERT_EQ(report.repairs.size(), whole.repairs.size()) << seed;
        for (std::size_t i = 0; i < whole.repairs.size(); ++i)
          EXPECT_EQ(describe(report.repairs[i]), describe(whole.repairs[i])) << seed;
      } catch (const InputError&) {
        Counter counter;
        EXPECT_THROW((void)reconstruct_out_of_core(source, {.cap = cap}, counter), InputError);
      }
    }
  }
}

TEST(Tips, EditsThatMakeThemComeAndGoAreAsAtOnce) {
  Reconstruction live;
  const auto expect = [&] { EXPECT_EQ(edits::difference(live, {}), ""); };
  for (int z = 0; z < 5; ++z) live.insert(Slice{double(z), {square(3)}});
  live.insert(Slice{5, {contour({{0, 0}})}});
  expect();
  live.replace(5, Slice{5, {contour({{1, 0}, {-1, 0}})}});
  expect();
  live.replace(2, Slice{2, {contour({{0, 0}})}});
  expect();
  live.move_contour(2, 0, {{1, 1}});
  expect();
  const SurfaceChange change = live.move_contour(2, 0, {{5, 5}});
  ASSERT_EQ(change.repairs.size(), 1U);
  EXPECT_EQ(change.repairs[0].kind, DefectKind::too_few_points);
  expect();
  live.remove(2);
  expect();
  live.remove(5);
  expect();
}

}  // namespace
}  // namespace loft
