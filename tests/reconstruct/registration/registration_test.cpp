// SPDX-License-Identifier: MIT
// What moves, turns or folds by more than its thickness stays whole: it is moved over what it was
// before its tiles are chosen.
#include "reconstruct/registration/registration.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <span>
#include <vector>

#include "cdt/check.h"
#include "cdt/effort.h"
#include "mesh/measure.h"
#include "mesh/vec3.h"
#include "reconstruct/clean/cleaning.h"
#include "reconstruct/reconstruct.h"
#include "reconstruct/reconstruction.h"
#include "reconstruct/registration/courses.h"
#include "reconstruct/registration/displacement.h"
#include "reconstruct/registration/matching.h"
#include "reconstruct/registration/nearest.h"
#include "tests/cases.h"
#include "tests/reconstruct/live/edit_script.h"
#include "tests/reconstruct/solid.h"
#include "tests/reconstruct/stacks.h"

namespace loft {
namespace {

using cdt::Point;
using std::numbers::pi;

/// A wall along a wave, as one outline: the wave and its other side.
std::vector<Point> wavy_wall(double phase, double thickness) {
  std::vector<Point> outline;
  const auto wave = [&](double x) { return 2.5 * std::sin(2 * pi * x / 10 + phase); };
  constexpr int count = 120;
  for (int i = 0; i <= count; ++i) {
    const double x = -20 + 40.0 * i / count;
    outline.push_back({x, wave(x) - thickness / 2});
  }
  for (int i = count; i >= 0; --i) {
    const double x = -20 + 40.0 * i / count;
    outline.push_back({x, wave(x) + thickness / 2});
  }
  return outline;
}

std::vector<Slice> travelling_folds(double thickness = 1) {
  std::vector<Slice> slices;
  for (int i = 0; i < 3; ++i) slices.push_back({2.0 * i, {{wavy_wall(1.2 * i, thickness), ""}}});
  return slices;
}

/// A profile that is open above: floor and two upright walls, 3 thick.
std::vector<Point> profile(double floor, double aside = 0) {
  std::vector<Point> outline{{0, floor},      {40, floor},    {40, 50}, {37, 50},
                             {37, floor + 3}, {3, floor + 3}, {3, 50},  {0, 50}};
  for (Point& p : outline) p.x += aside;
  return outline;
}

/// The wall of a square hopper: a frame 5 wide, `inset` from the border.
Slice frame(double z, double inset) {
  const auto square = [](double low) {
    return std::vector<Point>{
        {low, low}, {100 - low, low}, {100 - low, 100 - low}, {low, 100 - low}};
  };
  return {z, {{square(inset), ""}, {square(inset + 5), ""}}};
}

std::vector<Slice> turned(std::vector<Slice> slices, double angle, double mirrored = 1) {
  for (Slice& slice : slices)
    for (Contour& contour : slice.contours)
      for (Point& p : contour.points)
        p = {mirrored * (p.x * std::cos(angle) - p.y * std::sin(angle)),
             p.x * std::sin(angle) + p.y * std::cos(angle)};
  return slices;
}

Measures of_solid(const std::vector<Slice>& slices, const Options& options = {}) {
  const Reconstructed made = reconstruct(slices, options);
  EXPECT_EQ(solids::faults(made.surface), "");
  return measure(made.surface);
}

void expect_whole(const std::vector<Slice>& slices, int genus, double volume, double tolerance,
                  const Options& options = {}) {
  const Measures made = of_solid(slices, options);
  EXPECT_EQ(made.components, 1U);
  EXPECT_EQ(made.genus, genus);
  EXPECT_NEAR(made.volume, volume, tolerance * volume);
}

TEST(Registration, AFoldedWallWhoseFoldsTravelIsOneSheet) {
  expect_whole(travelling_folds(), 0, 160, 0.1);
}

TEST(Registration, AThinnerFoldedWallIsOneSheetToo) {
  expect_whole(travelling_folds(0.7), 0, 112, 0.1);
}

TEST(Registration, ProfilesOfDifferentDepthHaveNoWindowBetweenTheirFloors) {
  const std::vector<Slice> slices{{0, {{profile(0), ""}}}, {20, {{profile(12, 2), ""}}}};
  const Measures made = of_solid(slices);
  EXPECT_EQ(made.components, 1U);
  EXPECT_EQ(made.genus, 0);
}

TEST(Registration, ASlantedWallAllRoundIsOneRing) {
  std::vector<Slice> slices;
  for (int i = 0; i < 5; ++i) slices.push_back(frame(15.0 * i, 8.75 * i));
  expect_whole(slices, 1, 72000, 1e-9);
}

TEST(Registration, AnOrderLinksRingsThatLieWithinEachOther) {
  Options options;
  options.links = {{{0, 0}, {1, 0}, true}};
  const std::vector<Slice> slices{frame(0, 0), frame(60, 35)};
  const Reconstructed made = reconstruct(slices, options);
  EXPECT_TRUE(made.repairs.empty());
  expect_whole(slices, 1, 72000, 1e-9, options);
}

TEST(Registration, AFilamentIsFollowedAsFarAsMaxShiftAllows) {
  std::vector<Slice> slices;
  for (int i = 0; i < 6; ++i) slices.push_back({1.0 * i, {stacks::circle(12, 1, {4.5 * i, 0})}});
  EXPECT_EQ(of_solid(slices).components, 6U);
  Options options;
  options.max_shift = 6;
  expect_whole(slices, 0, 15, 1e-9, options);
}

/// Points of each contour from another one on, or the other way round.
std::vector<Slice> begun_elsewhere(std::vector<Slice> slices, std::ptrdiff_t by, bool is_reversed) {
  for (Slice& slice : slices) {
    for (Contour& contour : slice.contours) {
      std::vector<Point>& points = contour.points;
      const auto count = static_cast<std::ptrdiff_t>(points.size());
      std::rotate(points.begin(), points.begin() + by % count, points.end());
      if (is_reversed) std::ranges::reverse(points);
    }
  }
  return slices;
}

std::vector<Slice> upside_down(std::vector<Slice> slices) {
  for (Slice& slice : slices) slice.z = -slice.z;
  return slices;
}

/// The law of the turned stack, for what registration decides.
void expect_same_however_turned(const std::vector<Slice>& slices) {
  const Measures before = of_solid(slices);
  const auto expect_same = [&](const std::vector<Slice>& others, const char* how) {
    SCOPED_TRACE(how);
    const Measures after = of_solid(others);
    EXPECT_EQ(after.components, before.components);
    EXPECT_EQ(after.genus, before.genus);
    EXPECT_NEAR(after.volume, before.volume, 1e-6 * before.volume);
  };
  expect_same(turned(slices, 0.3), "turned by 0.3");
  expect_same(turned(slices, 2.0), "turned by 2.0");
  expect_same(turned(slices, 1.1, -1), "turned and mirrored");
  expect_same(turned(slices, 0, -1), "mirrored");
  expect_same(upside_down(slices), "upside down");
  expect_same(begun_elsewhere(slices, 3, false), "begun elsewhere");
  expect_same(begun_elsewhere(slices, 1, true), "the other way round");
}

TEST(Registration, AFoldedWallIsTheSameHoweverItIsTurned) {
  expect_same_however_turned(travelling_folds());
}

TEST(Registration, AHopperIsTheSameHoweverItIsTurned) {
  std::vector<Slice> hopper;
  for (int i = 0; i < 4; ++i) hopper.push_back(frame(15.0 * i, 8.75 * i));
  expect_same_however_turned(hopper);
}

TEST(Registration, ProfilesOfDifferentDepthAreTheSameHoweverTheyAreTurned) {
  expect_same_however_turned({{0, {{profile(0), ""}}}, {20, {{profile(12, 2), ""}}}});
}

std::vector<Slice> turning_bar(double angle) {
  const std::vector<Slice> bar{{0, {{{{-20, -0.5}, {20, -0.5}, {20, 0.5}, {-20, 0.5}}, ""}}}};
  std::vector<Slice> slices = turned(bar, angle);
  slices[0].z = 20;
  slices.insert(slices.begin(), bar[0]);
  return slices;
}

TEST(Registration, AThinBarThatTurnsIsTheSameHoweverItIsTurned) {
  expect_same_however_turned(turning_bar(pi / 4));
  expect_same_however_turned(turning_bar(0.5));
}

TEST(Registration, EditsLeadToTheSameSurfaceAsTheWholeStack) {
  std::vector<Slice> pool;
  for (int i = 0; i < 5; ++i) pool.push_back({2.0 * i, {{wavy_wall(1.2 * i, 1), ""}}});
  EXPECT_EQ(edits::fault_of_edits(pool, 7, 12), "");
}

TEST(Registration, IsReportedAsSuch) {
  Options options;
  options.reports_slabs = true;
  const Reconstructed made = reconstruct(travelling_folds(), options);
  for (const SlabReport& slab : made.slabs) {
    ASSERT_EQ(slab.links.size(), 1U);
    EXPECT_EQ(slab.links[0].reason, LinkReason::registered);
    EXPECT_GT(slab.links[0].overlap, 0.6);
  }
}

TEST(Registration, SaysHowFarAPartTurned) {
  const std::vector<Point> bar{{-20, -0.5}, {20, -0.5}, {20, 0.5}, {-20, 0.5}};
  std::vector<Point> other;
  for (const Point p : bar)
    other.push_back(
        {p.x * std::cos(0.1) - p.y * std::sin(0.1), p.x * std::sin(0.1) + p.y * std::cos(0.1)});
  Options options;
  options.reports_slabs = true;
  const Reconstructed made =
      reconstruct(std::vector<Slice>{{0, {{bar, ""}}}, {20, {{other, ""}}}}, options);
  ASSERT_EQ(made.slabs.at(0).links.size(), 1U);
  const LinkReport& link = made.slabs[0].links[0];
  EXPECT_EQ(link.reason, LinkReason::registered);
  EXPECT_NEAR(link.turn, 0.1 * 180 / pi, 0.5);
  EXPECT_NEAR(link.confidence, link.overlap / 1.1, 0.02);
}

Region region_of(const Slice& slice) {
  std::vector<ContourSource> sources;
  for (const Contour& contour : slice.contours)
    sources.push_back({contour.points, 0, static_cast<std::uint32_t>(sources.size())});
  std::vector<Defect> repairs;
  return clean(sources, slice.z, {}, repairs);
}

Region region_of(const std::vector<Point>& outline, double z = 0) {
  return region_of(Slice{z, {{outline, ""}}});
}

constexpr std::array<Point, 1> one_offset{};

TEST(Registration, LeavesAloneWhatHasNotAsManyLoops) {
  const Region ring = region_of(frame(0, 0));
  const Region square = region_of({{0, 0}, {100, 0}, {100, 100}, {0, 100}}, 1);
  EXPECT_FALSE(tile_registered(ring, square, one_offset, any_number));
}

TEST(Registration, AThinBarThatTurnsKeepsItsVolume) {
  expect_whole(turning_bar(pi / 4), 0, 800, 0.1);
}

/// A tube that forks, slanted: circles of 24 points that move by their radius from slice to slice.
std::vector<Slice> slanted_fork() {
  const auto circle = [](double radius, Point centre) {
    return stacks::circle(24, radius, centre);
  };
  return {{0, {circle(5, {-6, 1})}},
          {6, {circle(5, {0, 0})}},
          {12, {circle(4, {6, 4.5}), circle(3.5, {5.2, -4})}},
          {18, {circle(4, {11, 8}), circle(3.5, {9, -8})}}};
}

TEST(Registration, ASlantedForkKeepsItsVolume) {
  const std::vector<Slice> slices = slanted_fork();
  double frusta = 0;
  for (std::size_t i = 0; i + 1 < slices.size(); ++i) {
    const double a = area(region_of(slices[i]));
    const double b = area(region_of(slices[i + 1]));
    frusta += (slices[i + 1].z - slices[i].z) * (a + b + std::sqrt(a * b)) / 3;
  }
  expect_whole(slices, 0, frusta, 0.08);
  Options as_it_lies;
  as_it_lies.link = LinkRule::overlap;
  EXPECT_LT(of_solid(slices, as_it_lies).volume, 0.86 * frusta);
}

TEST(Registration, AForkIsTheSameHoweverItIsTurned) { expect_same_however_turned(slanted_fork()); }

/// One circle that becomes two or three, all of as many points that begin alike: many of their
/// edges are parallel, so that which of two diagonals is there is often rounding's choice.
std::vector<Slice> random_fork(std::mt19937_64& random) {
  std::uniform_real_distribution<double> any(-1, 1);
  const std::size_t points = 8 + 4 * (random() % 6);
  const std::size_t branches = 2 + random() % 2;
  const bool is_symmetric = random() % 4 == 0;
  const double height = 4 + 2 * any(random);
  std::vector<Slice> slices;
  for (int i = 0; i < 2; ++i)
    slices.push_back({height * i, {stacks::circle(points, 5 + 0.5 * any(random), {0, 0})}});
  const double spread = 4 + 0.5 * any(random);
  for (int i = 2; i < 4; ++i) {
    Slice& slice = slices.emplace_back(Slice{height * i, {}});
    for (std::size_t k = 0; k < branches; ++k) {
      const double off = is_symmetric ? 0 : 0.3 * any(random);
      const double turn = 2 * pi * (static_cast<double>(k) + off) / static_cast<double>(branches);
      const double out = spread * (0.4 + 0.3 * i) + (is_symmetric ? 0 : 0.3 * any(random));
      slice.contours.push_back(stacks::circle(points, 2 + (is_symmetric ? 0 : 0.4 * any(random)),
                                              {out * std::cos(turn), out * std::sin(turn)}));
    }
  }
  return slices;
}

TEST(Registration, AnyForkIsTheSameHoweverItIsTurned) {
  for (std::uint64_t seed = 0; seed < cases(100); ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937_64 random(seed);
    expect_same_however_turned(random_fork(random));
  }
}

TEST(Registration, EditsOfAForkLeadToTheSameSurfaceAsTheWholeStack) {
  EXPECT_EQ(edits::fault_of_edits(slanted_fork(), 11, 12), "");
}

TEST(Registration, KnowsHowFarAPartTurns) {
  std::vector<Point> bar{{-20, -2}, {20, -2}, {20, 2}, {-20, 2}};
  std::vector<Point> other;
  for (const Point p : bar)
    other.push_back({p.x * std::cos(0.3) - p.y * std::sin(0.3) + 1,
                     p.x * std::sin(0.3) + p.y * std::cos(0.3) + 2});
  const auto made = tile_registered(region_of(bar), region_of(other, 5), one_offset, any_number);
  ASSERT_TRUE(made);
  EXPECT_NEAR(made->motion.turn, 0.3, 0.1);
  EXPECT_NEAR(made->motion.shift.y, 2, 0.3);
  EXPECT_LT(made->difference, 0.1 * (160 + 160));
}

/// What tiles between two regions enclose, by what they cover at their heights.
double enclosed(const Region& lower, const Region& upper, const TileSet& tiles) {
  double sum = (upper.z - lower.z) * area(upper);
  for (const Tile& tile : tiles.tiles) {
    std::array<Vec3, 3> p;
    for (unsigned i = 0; i < 3; ++i) p[i] = place_of(lower, upper, tiles.inner, tile.nodes[i]);
    const Vec3 normal = cross(minus(p[1], p[0]), minus(p[2], p[0]));
    sum += normal[2] / 2 * ((p[0][2] + p[1][2] + p[2][2]) / 3 - lower.z);
  }
  return sum;
}

/// What is between the hyperbolic paraboloids through a bar's edges and its sides, turned.
TEST(Registration, TwistedQuadsBulgeToNeitherSide) {
  for (const double angle : {0.2, -0.2}) {
    std::vector<Point> bar{{-10, -3}, {10, -3}, {10, 3}, {-10, 3}};
    std::vector<Point> other;
    for (const Point p : bar)
      other.push_back({p.x * std::cos(angle) - p.y * std::sin(angle),
                       p.x * std::sin(angle) + p.y * std::cos(angle)});
    const Region lower = region_of(bar);
    const Region upper = region_of(other, 5);
    const auto made = tile_registered(lower, upper, one_offset, any_number);
    ASSERT_TRUE(made);
    EXPECT_NEAR(enclosed(lower, upper, made->tiles), 600 * (2 + std::cos(angle)) / 3, 1e-9);
  }
}

TEST(Matching, FindsWhatATestOfAllStretchesFinds) {
  constexpr std::uint64_t seed = 20261128;
  std::mt19937_64 random(seed);
  const auto any = [&] { return static_cast<double>(random() % 1000) / 100; };
  const auto some = [&](std::size_t count) {
    std::vector<Stretch> made(count);
    for (Stretch& stretch : made) {
      const double angle = any();
      stretch.middle = {any(), any()};
      stretch.normal = {std::cos(angle), std::sin(angle)};
    }
    return made;
  };
  const auto cost = [](const Stretch& a, const Stretch& b, double weight) {
    const double x = a.middle.x - b.middle.x;
    const double y = a.middle.y - b.middle.y;
    return x * x + y * y + weight * (1 - a.normal.x * b.normal.x - a.normal.y * b.normal.y);
  };
  for (int round = 0; round < 50; ++round) {
    const std::vector<Stretch> stretches = some(1 + random() % 60);
    const double weight = round % 5;
    const StretchTree tree(stretches, weight);
    for (const Stretch& wanted : some(20)) {
      double least = std::numeric_limits<double>::infinity();
      for (const Stretch& stretch : stretches)
        least = std::min(least, cost(wanted, stretch, weight));
      const auto found = tree.nearest(wanted);
      EXPECT_NEAR(found.cost, least, 1e-9) << "seed " << seed << " round " << round;
      EXPECT_NEAR(cost(wanted, stretches[found.index], weight), least, 1e-9);
    }
  }
}

TEST(Matching, FindsTheSameLoopAgainWhereverItBegins) {
  const Region region = region_of({{0, 0}, {9, 1}, {12, 6}, {5, 4}, {1, 8}});
  for (const double length : {4.0, 0.3, 0.01}) {  // in one go, or by runs first
    const auto loop = stretches_by_edges(region, 0, length);
    const auto third = static_cast<std::ptrdiff_t>(loop.size() / 3);
    std::vector<Stretch> later(loop.begin() + third, loop.end());
    later.insert(later.end(), loop.begin(), loop.begin() + third);
    const std::vector<Match> matches = match_outlines(loop, later, 1, 1);
    EXPECT_EQ(matches.size(), loop.size());
    for (const Match match : matches)
      EXPECT_EQ(match.lower, (match.upper + static_cast<std::size_t>(third)) % loop.size());
  }
}

/// Of pairs in their order once round both loops: what that way costs.
double cost_of_way(const PairGrid& grid, std::span<const Match> pairs) {
  double sum = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const Match from = pairs[i];
    const Match to = pairs[(i + 1) % pairs.size()];
    const double before = grid.cost(from.lower, from.upper);
    const double after = grid.cost(to.lower, to.upper);
    const double row_step = grid.row_step(to.lower);
    const double column_step = *grid.column_steps(to.upper);
    if (from.lower == to.lower)
      sum += grid.step_one(before, after, column_step);
    else if (from.upper == to.upper)
      sum += grid.step_one(before, after, row_step);
    else
      sum += grid.step_both(before, after, row_step, column_step);
  }
  return sum;
}

TEST(Matching, FindsTheLeastOfAllWaysRound) {
  constexpr std::uint64_t seed = 20261130;
  std::mt19937_64 random(seed);
  const auto star = [&](int corners) {
    std::vector<Point> points;
    for (int i = 0; i < corners; ++i) {
      const double angle = 2 * pi * i / corners;
      const double radius = 1 + static_cast<double>(random() % 1000) / 200;
      points.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    }
    return region_of(points);
  };
  for (int round = 0; round < 60; ++round) {
    const auto lower = stretches_by_edges(star(3 + round % 9), 0, 0.8);
    const auto upper = stretches_by_edges(star(3 + round % 7), 0, 0.9);
    const double weight = 1 << round % 8;
    const PairGrid grid(lower, upper, weight, weight / 8);
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t start = 0; start < upper.size(); ++start) {
      const std::vector<ColumnRange> all(lower.size() + 1, {start, start + upper.size() + 1});
      least = std::min(least, Courses(grid, 0, all).least());
    }
    const std::vector<Match> found = match_outlines(lower, upper, weight, weight / 8);
    EXPECT_NEAR(cost_of_way(grid, found), least, 1e-8 * least)
        << "seed " << seed << " round " << round;
  }
}

/// Teeth across teeth match badly everywhere: a way round costs about the same wherever it starts,
/// and yet few of them are gone through to the end.
TEST(Matching, OfCrossedCombsTakesNoMoreThanSomePassesOverAllPairs) {
  const std::vector<Point> comb{{0, 0}, {1, 6}, {2, 0},  {3, 6}, {4, 0},
                                {5, 6}, {6, 0}, {6, -1}, {0, -1}};
  std::vector<Point> across;
  for (const Point p : comb) across.push_back({-p.y, p.x});
  const auto lower = stretches_by_edges(region_of(comb), 0, 0.2);
  const auto upper = stretches_by_edges(region_of(across), 0, 0.2);
  cdt::Effort effort(20 * lower.size() * upper.size() / 16);
  EXPECT_NO_THROW(static_cast<void>(match_outlines(lower, upper, 20, 2.5)));
}

/// However it is pulled, what comes out is a region still: no loop crosses another one or itself.
TEST(Displacement, LeavesARegionARegion) {
  std::mt19937 random(20261128);
  std::uniform_real_distribution<double> way(-8, 8);
  const Region region = region_of(frame(0, 0));
  int moves = 0;
  for (int i = 0; i < 200; ++i) {
    SCOPED_TRACE(i);
    std::vector<Pull> pulls;
    for (std::uint32_t loop = 0; loop < 2; ++loop)
      for (const Stretch& stretch : stretches_by_edges(region, loop, 25))
        pulls.push_back({stretch, {way(random), way(random)}, 1});
    const auto made = Displacement::fit(region, pulls, 1);
    if (!made) continue;
    const Region there = moved(region, made->ways());
    cdt::Triangulation mesh;
    insert_loops(there, mesh);
    EXPECT_EQ(mesh.vertex_count(), region.points.size());
    EXPECT_TRUE(cdt::check(mesh).empty());
    moves += made->ways()[0] != Point{};
  }
  EXPECT_GT(moves, 100);
}

}  // namespace
}  // namespace loft
