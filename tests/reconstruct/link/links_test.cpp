// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <set>

#include "mesh/measure.h"
#include "reconstruct/clean/cleaning.h"
#include "reconstruct/link/ends.h"
#include "reconstruct/link/linking.h"
#include "reconstruct/reconstruct.h"
#include "tests/cases.h"
#include "tests/reconstruct/solid.h"
#include "tests/reconstruct/stacks.h"

namespace loft {
namespace {

using solids::faults;
using std::numbers::pi;

/// Reconstructs and expects a solid.
Reconstructed solid(const std::vector<Slice>& slices, Options options = {}) {
  options.reports_slabs = true;
  Reconstructed made = reconstruct(slices, options);
  EXPECT_EQ(faults(made.surface), "");
  return made;
}

Measures measures(const Reconstructed& made) { return measure(to_mesh(made.surface)); }

/// How often which rule made which kind of link: `link predicted`.
std::map<std::string, int> count(const Reconstructed& made) {
  std::map<std::string, int> counts;
  for (const SlabReport& slab : made.slabs)
    for (const LinkReport& link : slab.links)
      ++counts[std::string(name(link.kind)) + ' ' + name(link.reason)];
  return counts;
}

using Counts = std::map<std::string, int>;

/// A disc of radius 1 that moves `step` a slice.
std::vector<Slice> moving_disc(int count, double step) {
  std::vector<Slice> slices;
  for (int i = 0; i < count; ++i)
    slices.push_back({double(i), {stacks::circle(40, 1, {step * i, -0.3 * step * i})}});
  return slices;
}

/// The area of a circle of 40 points.
double disc_area() { return 20 * std::sin(pi / 20); }

TEST(Links, ADiscThatMovesKeepsItsVolume) {
  for (const double step : {0.3, 0.7, 1.1, 1.5, 1.9, 2.5, 3.0, 3.5}) {
    SCOPED_TRACE(step);
    const Reconstructed made = solid(moving_disc(9, step));
    EXPECT_EQ(measures(made).components, 1U);
    EXPECT_NEAR(measures(made).volume / (8 * disc_area()), 1, 0.02);
  }
}

TEST(Links, TwoSlicesAreEnough) {
  const Reconstructed made = solid(moving_disc(2, 2.5));
  EXPECT_EQ(count(made), (Counts{{"link nearest", 1}}));
  EXPECT_NEAR(measures(made).volume, disc_area(), 0.01);
}

TEST(Links, UnevenGapsArePredictedByTheirHeights) {
  std::vector<Slice> slices;
  for (const double z : {0.0, 1.0, 1.5, 3.0, 4.2, 5.0, 7.0})
    slices.push_back({z, {stacks::circle(40, 1, {2.7 * z, 0.5 * z})}});
  const Reconstructed made = solid(slices);
  EXPECT_EQ(measures(made).components, 1U);
  EXPECT_NEAR(measures(made).volume / (7 * disc_area()), 1, 0.01);
}

TEST(Links, DiscsThatPassEachOtherKeepTheirWays) {
  std::vector<Slice> slices;
  for (int i = 0; i < 11; ++i)
    slices.push_back(
        {double(i),
         {stacks::circle(40, 1, {2.4 * i, 0}), stacks::circle(40, 1, {24 - 2.4 * i, 2.6})}});
  const Reconstructed made = solid(slices);
  EXPECT_EQ(measures(made).components, 2U);
  EXPECT_EQ(count(made), (Counts{{"link predicted", 20}}));
  EXPECT_NEAR(measures(made).volume / (20 * disc_area()), 1, 0.01);
}

TEST(Links, AHelixOfTwoStrands) {
  std::vector<Slice> slices;
  for (int i = 0; i < 20; ++i) {
    Slice slice{double(i), {}};
    for (const double turn : {0.0, pi})
      slice.contours.push_back(
          stacks::circle(30, 1, {6 * std::cos(0.5 * i + turn), 6 * std::sin(0.5 * i + turn)}));
    slices.push_back(slice);
  }
  const Reconstructed made = solid(slices);
  EXPECT_EQ(measures(made).components, 2U);
  EXPECT_EQ(count(made), (Counts{{"link predicted", 38}}));
}

TEST(Links, ASlantedPipeStaysHollow) {
  for (const double step : {1.5, 3.0}) {
    SCOPED_TRACE(step);
    std::vector<Slice> slices;
    for (int i = 0; i < 8; ++i)
      slices.push_back(
          {double(i),
           {stacks::circle(60, 1, {step * i, 0}), stacks::circle(50, 0.8, {step * i, 0})}});
    const Measures measured = measures(solid(slices));
    EXPECT_EQ(measured.components, 1U);
    EXPECT_EQ(measured.genus, 1);
    EXPECT_NEAR(measured.volume / (7 * pi * (1 - 0.64)), 1, 0.01);
  }
}

TEST(Links, ASlantedChannelGoesThrough) {
  std::vector<Slice> slices;
  for (int i = 0; i < 6; ++i)
    slices.push_back({double(i),
                      {stacks::square(20), stacks::circle(40, 1, {3.0 * i - 8, 0}),
                       stacks::circle(40, 0.5, {3.0 * i - 8, 0})}});
  const Measures measured = measures(solid(slices));
  EXPECT_EQ(measured.components, 2U);  // the block, and a rod in its channel
  EXPECT_EQ(measured.genus, 1);
  EXPECT_NEAR(measured.volume, 5 * (1600 - pi + pi / 4), 0.2);
}

/// A trunk that forks in two, and each of these again; the branches move by more than their width.
std::vector<Slice> slanted_tree() {
  std::vector<Slice> slices;
  for (int i = 0; i < 4; ++i) slices.push_back({double(i), {stacks::circle(40, 1.5)}});
  for (int i = 0; i < 6; ++i) {
    Slice slice{4.0 + i, {}};
    for (const double side : {-1.0, 1.0})
      slice.contours.push_back(stacks::circle(40, 1, {side * (1.2 + 2.3 * i), 0}));
    slices.push_back(slice);
  }
  for (int i = 0; i < 6; ++i) {
    Slice slice{10.0 + i, {}};
    for (const double side : {-1.0, 1.0})
      for (const double across : {-1.0, 1.0})
        slice.contours.push_back(stacks::circle(30, 0.7, {side * 12.7, across * (0.8 + 1.6 * i)}));
    slices.push_back(slice);
  }
  return slices;
}

double area(const Contour& contour) {
  double sum = 0;
  for (std::size_t i = 0; i < contour.points.size(); ++i) {
    const cdt::Point p = contour.points[i];
    const cdt::Point q = contour.points[(i + 1) % contour.points.size()];
    sum += p.x * q.y - p.y * q.x;
  }
  return sum / 2;
}

double area(const Slice& slice) {
  double sum = 0;
  for (const Contour& contour : slice.contours) sum += area(contour);
  return sum;
}

TEST(Links, ATreeOfSlantedBranchesIsOnePiece) {
  const auto slices = slanted_tree();
  double expected = 0;
  for (std::size_t i = 0; i + 1 < slices.size(); ++i)
    expected += (area(slices[i]) + area(slices[i + 1])) / 2;
  const Reconstructed made = solid(slices);
  EXPECT_EQ(measures(made).components, 1U);
  EXPECT_EQ(measures(made).genus, 0);
  EXPECT_NEAR(measures(made).volume / expected, 1, 0.02);
  const Reconstructed plain = solid(slices, {.link = LinkRule::overlap});
  EXPECT_GT(measures(plain).components, 10U);
  EXPECT_LT(measures(plain).volume / expected, 0.9);
}

TEST(Links, AShellClosesAsOutlinesAndHoles) {
  // Discs below and above, of which none overlaps the next.
  const std::vector<Slice> slices{{0, {stacks::circle(30, 2.4)}},
                                  {1, {stacks::circle(40, 3.4), stacks::circle(30, 2.5)}},
                                  {2, {stacks::circle(40, 3.4), stacks::circle(30, 2.5)}},
                                  {3, {stacks::circle(30, 2.4)}}};
  const Reconstructed made = solid(slices);
  EXPECT_EQ(count(made), (Counts{{"birth predicted", 1},
                                 {"death predicted", 1},
                                 {"link predicted", 2},
                                 {"link overlap", 2}}));
  EXPECT_EQ(measures(made).components, 2U);
  EXPECT_EQ(measures(made).genus, 0);
}

TEST(Links, RoundEndsSideBySideAreNotLinked) {
  // A ball that ends where another one begins beside it, cut at any height.
  for (double offset = 0; offset < 1; offset += 0.125) {
    std::vector<Slice> slices;
    for (double z = -5 + offset; z < 5; ++z) {
      Slice slice{z, {}};
      for (const auto& [x, middle] : {std::pair{0.0, -2.3}, std::pair{4.0, 2.3}})
        if (const double r = 2.5 * 2.5 - (z - middle) * (z - middle); r > 0)
          slice.contours.push_back(stacks::circle(30, std::sqrt(r), {x, 0}));
      slices.push_back(slice);
    }
    SCOPED_TRACE(offset);
    EXPECT_EQ(measures(solid(slices)).components, 2U);
  }
}

TEST(Links, AStraightRodAndAnotherBesideItAreNotLinked) {
  std::vector<Slice> slices;
  for (int i = 0; i < 8; ++i)
    slices.push_back({double(i), {stacks::circle(30, 1, {i < 4 ? 0.0 : 2.5, 0})}});
  EXPECT_EQ(measures(solid(slices)).components, 2U);
}

TEST(Links, SpecksAreNotLinked) {
  // In every slice one that is nowhere near the next but one.
  std::vector<Slice> slices;
  for (int i = 0; i < 6; ++i)
    slices.push_back({double(i), {stacks::circle(30, 9), stacks::circle(8, 0.5, {12, 0})}});
  for (const int i : {0, 1, 4, 5}) slices[std::size_t(i)].contours.pop_back();
  for (cdt::Point& p : slices[2].contours[1].points) p.y += 1.7;
  EXPECT_EQ(count(solid(slices)),
            (Counts{{"birth overlap", 2}, {"death overlap", 2}, {"link overlap", 5}}));
}

TEST(Links, NothingMovesFartherThanAllowed) {
  const auto slices = moving_disc(6, 2.5);
  EXPECT_EQ(measures(solid(slices, {.max_shift = 3.0})).components, 1U);
  EXPECT_EQ(measures(solid(slices, {.max_shift = 2.0})).components, 6U);
  const auto overlapping = moving_disc(6, 1.5);
  const double plain = measures(solid(overlapping, {.link = LinkRule::overlap})).volume;
  EXPECT_EQ(measures(solid(overlapping, {.max_shift = 1.0})).volume, plain);
  EXPECT_GT(measures(solid(overlapping)).volume, 1.1 * plain);
}

TEST(Links, WithRuleNoneEverySliceStandsAlone) {
  const auto slices = stacks::y_branch(8, 40);
  const Reconstructed made = solid(slices, {.link = LinkRule::none});
  std::size_t contours = 0;
  for (const Slice& slice : slices) contours += slice.contours.size();
  EXPECT_EQ(measures(made).components, contours);
  EXPECT_TRUE(made.repairs.empty());
}

LinkOrder join(ContourId from, ContourId to) { return {from, to, true, {}}; }
LinkOrder part(ContourId from, ContourId to) { return {from, to, false, {}}; }

TEST(LinkOrders, JoinWhatIsFarApart) {
  const auto slices = moving_disc(3, 30);
  EXPECT_EQ(measures(solid(slices)).components, 3U);
  for (const LinkRule rule : {LinkRule::automatic, LinkRule::overlap, LinkRule::none}) {
    const Reconstructed made =
        solid(slices, {.link = rule, .links = {join({0, 0}, {1, 0}), join({2, 0}, {1, 0})}});
    EXPECT_EQ(measures(made).components, 1U);
    EXPECT_NEAR(measures(made).volume, 2 * disc_area(), 0.01);
    EXPECT_EQ(count(made), (Counts{{"link order", 2}}));
    EXPECT_TRUE(made.repairs.empty());
  }
}

TEST(LinkOrders, KeepApartWhatOverlaps) {
  const std::vector<Slice> slices{{0, {stacks::square(2), stacks::square(1, {9, 9})}},
                                  {1, {stacks::square(2), stacks::square(1, {9, 9})}},
                                  {2, {stacks::square(2), stacks::square(1, {9, 9})}}};
  const Reconstructed made = solid(slices, {.links = {part({0, 0}, {1, 0})}});
  EXPECT_TRUE(made.repairs.empty());
  EXPECT_EQ(measures(made).components, 3U);
  EXPECT_EQ(count(made), (Counts{{"birth order", 1}, {"death order", 1}, {"link overlap", 3}}));
}

TEST(LinkOrders, KeepApartWhatWouldBeLinked) {
  const auto slices = moving_disc(5, 2.5);
  const Reconstructed made = solid(slices, {.links = {part({3, 0}, {2, 0})}});
  EXPECT_EQ(measures(made).components, 2U);
  EXPECT_TRUE(made.repairs.empty());
}

TEST(LinkOrders, UntangleARowOfSlantedRods) {
  // Each disc overlaps its own next one and its neighbour's.
  std::vector<Slice> slices;
  Options options;
  for (std::uint32_t i = 0; i < 4; ++i) {
    Slice slice{double(i), {}};
    for (std::uint32_t k = 0; k < 4; ++k) {
      slice.contours.push_back(stacks::circle(30, 1, {1.3 * i + 2.5 * k, 0}));
      if (i > 0) options.links.push_back(join({i - 1, k}, {i, k}));
    }
    slices.push_back(slice);
  }
  EXPECT_EQ(measures(solid(slices)).components, 1U);
  options.link = LinkRule::none;
  const Reconstructed made = solid(slices, options);
  EXPECT_TRUE(made.repairs.empty());
  EXPECT_EQ(measures(made).components, 4U);
  EXPECT_EQ(count(made), (Counts{{"link order", 12}}));
}

TEST(LinkOrders, AreRefusedWhereTilesWouldMeet) {
  // Two rods upright side by side; crossing over would take them through each other.
  const std::vector<Slice> slices{{0, {stacks::circle(20, 1), stacks::circle(20, 1, {3, 0})}},
                                  {1, {stacks::circle(20, 1), stacks::circle(20, 1, {3, 0})}}};
  const Reconstructed made = solid(slices, {.links = {join({0, 0}, {1, 1}), join({0, 1}, {1, 0}),
                                                      part({0, 0}, {1, 0}), part({0, 1}, {1, 1})}});
  ASSERT_EQ(made.repairs.size(), 1U);
  EXPECT_EQ(made.repairs[0].kind, DefectKind::refused_link);
  EXPECT_EQ(made.repairs[0].slice, 0U);
  EXPECT_EQ(made.repairs[0].contour, 1U);
  EXPECT_EQ(measures(made).components, 3U);
}

TEST(LinkOrders, ReachHoles) {
  std::vector<Slice> slices;
  for (int i = 0; i < 2; ++i)
    slices.push_back({double(i), {stacks::square(20), stacks::circle(20, 1, {12.0 * i - 6, 0})}});
  EXPECT_EQ(measures(solid(slices)).genus, 0);
  const Reconstructed made = solid(slices, {.links = {join({0, 1}, {1, 1})}});
  EXPECT_TRUE(made.repairs.empty());
  EXPECT_EQ(measures(made).genus, 1);
  const Reconstructed mixed = solid(slices, {.links = {join({0, 1}, {1, 0})}});
  ASSERT_EQ(mixed.repairs.size(), 1U);
  EXPECT_EQ(mixed.repairs[0].message,
            "not linked with slice 1 contour 0: one bounds a part, the other a hole");
}

TEST(LinkOrders, ThatMakeNoSenseAreAllNamed) {
  auto slices = moving_disc(4, 1);
  slices[3].contours[0].label = "heart";
  const std::vector<LinkOrder> orders{
      {{0, 0}, {9, 0}, true, "links.ndjson:1"}, {{0, 7}, {1, 0}, true, "links.ndjson:2"},
      {{0, 0}, {2, 0}, true, "links.ndjson:3"}, {{2, 0}, {3, 0}, true, "links.ndjson:4"},
      {{0, 0}, {1, 0}, true, "links.ndjson:5"}, {{1, 0}, {0, 0}, false, "links.ndjson:6"}};
  EXPECT_EQ(
      find_bad_orders(slices, orders),
      (std::vector<std::string>{
          "links.ndjson:1: there is no slice 9; the stack has 4, counted from 0",
          "links.ndjson:2: there is no slice 0 contour 7; that slice has 1, counted from 0",
          "links.ndjson:3: slice 0 contour 0 and slice 2 contour 0 are not in neighbouring slices",
          "links.ndjson:4: slice 2 contour 0 and slice 3 contour 0 have different labels, '' and "
          "'heart'",
          "links.ndjson:6: slice 1 contour 0 and slice 0 contour 0 are to be linked and not to be "
          "linked, see links.ndjson:5"}));
  EXPECT_THROW((void)reconstruct(slices, {.links = orders}), InputError);
}

TEST(LinkOrders, OfOtherLabelsAreLeftOut) {
  auto slices = moving_disc(3, 30);
  for (Slice& slice : slices) {
    slice.contours.push_back(stacks::square(1, {200, 0}));
    slice.contours[1].label = "heart";
  }
  const Options options{.label = "heart", .links = {join({0, 0}, {1, 0}), part({1, 1}, {2, 1})}};
  const Reconstructed made = solid(slices, options);
  EXPECT_TRUE(made.repairs.empty());
  EXPECT_EQ(measures(made).components, 2U);
}

/// Vertices of the surface, sorted.
std::vector<std::array<double, 3>> places(const Reconstructed& made) {
  std::vector<std::array<double, 3>> all;
  for (const auto v : made.surface.vertices()) {
    const auto& p = made.surface.point(v);
    all.push_back({p[0], p[1], p[2]});
  }
  std::ranges::sort(all);
  return all;
}

/// Discs and rings that wander, begin and end.
std::vector<Slice> wandering(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  struct Mover {
    cdt::Point place;
    cdt::Point step;
    double radius;
    std::size_t points;
    bool is_ring;
    int first;
    int last;
  };
  std::vector<Mover> movers;
  for (int i = 0; i < 8; ++i)
    movers.push_back({{12 * uniform(random), 12 * uniform(random)},
                      {3 * uniform(random), 3 * uniform(random)},
                      1 + 0.7 * uniform(random),
                      8 + random() % 20,
                      random() % 3 == 0,
                      int(random() % 3),
                      3 + int(random() % 5)});
  std::vector<Slice> slices;
  for (int i = 0; i < 8; ++i) {
    Slice slice{i + 0.3 * uniform(random), {}};
    for (const Mover& mover : movers) {
      if (i < mover.first || i > mover.last) continue;
      const cdt::Point place{mover.place.x + i * mover.step.x, mover.place.y + i * mover.step.y};
      slice.contours.push_back(stacks::circle(mover.points, mover.radius, place, 0.1 * i));
      if (mover.is_ring)
        slice.contours.push_back(stacks::circle(mover.points, 0.6 * mover.radius, place));
    }
    slices.push_back(slice);
  }
  return slices;
}

// Steiner points were computed from the first corner of a triangle, and differed in the last bit.
TEST(Links, DoNotDependOnTheOrderOfContours) {
  for (std::uint64_t seed = 0; seed < cases(20); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const Options options{.link = seed % 2 == 0 ? LinkRule::automatic : LinkRule::overlap};
    auto slices = wandering(seed);
    const auto before = places(solid(slices, options));
    std::mt19937_64 random(seed);
    for (Slice& slice : slices) {
      std::ranges::shuffle(slice.contours, random);
      for (Contour& contour : slice.contours) {
        auto& points = contour.points;
        std::rotate(points.begin(), points.begin() + std::ptrdiff_t(random() % points.size()),
                    points.end());
        if (random() % 2 == 0) std::ranges::reverse(points);
      }
    }
    std::ranges::shuffle(slices, random);
    EXPECT_TRUE(places(solid(slices, options)) == before);
  }
}

TEST(Links, OfAMirroredStackAreMirrored) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    auto slices = wandering(seed);
    const Reconstructed made = solid(slices);
    for (Slice& slice : slices)
      for (Contour& contour : slice.contours)
        for (cdt::Point& p : contour.points) p.x = -p.x;
    const Reconstructed mirrored = solid(slices);
    EXPECT_EQ(count(mirrored), count(made));
    EXPECT_EQ(measures(mirrored).components, measures(made).components);
    for (Slice& slice : slices) slice.z = -slice.z;
    EXPECT_EQ(measures(solid(slices)).components, measures(made).components);
  }
}

TEST(Links, OfAnyWanderersMakeASolid) {
  for (std::uint64_t seed = 100; seed < 100 + cases(60); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const auto slices = wandering(seed);
    std::mt19937_64 random(seed);
    Options options;
    if (seed % 3 == 1) options.link = LinkRule::none;
    std::map<std::pair<ContourId, ContourId>, bool> orders;
    for (std::uint32_t i = 0; i + 1 < slices.size() && seed % 2 == 0; ++i) {
      if (slices[i].contours.empty() || slices[i + 1].contours.empty()) continue;
      for (int k = 0; k < 2; ++k)
        orders[{{i, std::uint32_t(random() % slices[i].contours.size())},
                {i + 1, std::uint32_t(random() % slices[i + 1].contours.size())}}] =
            random() % 2 == 0;
    }
    for (const auto& [pair, is_link] : orders)
      options.links.push_back({pair.first, pair.second, is_link, {}});
    (void)solid(slices, options);
  }
}

/// The tiles of each slab.
std::vector<std::vector<std::array<Vec3, 3>>> tiles(const std::vector<Slice>& slices) {
  std::vector<Region> regions;
  std::vector<Defect> repairs;
  for (std::uint32_t i = 0; i < slices.size(); ++i) {
    std::vector<ContourSource> sources;
    for (std::uint32_t c = 0; c < slices[i].contours.size(); ++c)
      sources.push_back({slices[i].contours[c].points, i, c});
    regions.push_back(clean(sources, slices[i].z, {}, repairs));
  }
  const Options options;
  Linking linking(options);
  TileWorkspace workspace;
  for (const Region& region : regions) linking.add(region);
  for (std::size_t i = 0; i < linking.slab_bound(); ++i) linking.tile(i, workspace);
  for (std::size_t i = 0; i < linking.slab_bound(); ++i) linking.match(i);
  for (std::size_t i = 0; i < linking.slab_bound(); ++i) linking.link(i);
  std::vector<std::vector<std::array<Vec3, 3>>> all;
  for (std::size_t i = 0; i < linking.slab_bound(); ++i) {
    auto& slab = all.emplace_back();
    const TileSet& set = linking.tiles(i);
    for (const Tile& tile : set.tiles)
      slab.push_back({place_of(regions[i], regions[i + 1], set.inner, tile.nodes[0]),
                      place_of(regions[i], regions[i + 1], set.inner, tile.nodes[1]),
                      place_of(regions[i], regions[i + 1], set.inner, tile.nodes[2])});
    std::ranges::sort(slab);
  }
  return all;
}

TEST(Links, AnEditOfASliceChangesFourSlabsAtMost) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    auto slices = wandering(seed);
    const auto before = tiles(slices);
    const std::size_t edited = seed % slices.size();
    for (Contour& contour : slices[edited].contours)
      for (cdt::Point& p : contour.points) p.x += 0.9;
    const auto after = tiles(slices);
    for (std::size_t i = 0; i < before.size(); ++i)
      if (i + 2 < edited || i > edited + 1) {
        EXPECT_TRUE(after[i] == before[i]) << "slab " << i << ", slice " << edited;
      }
  }
}

TEST(LinkReport, TellsWhatHappensToTheParts) {
  const std::vector<Slice> slices{
      {0, {stacks::square(2)}},
      {1, {stacks::square(2), stacks::square(1, {20, 0})}},
      {2, {stacks::square(0.5, {-1, 0}), stacks::square(0.5, {1, 0}), stacks::square(1, {20, 0})}},
      {3, {stacks::square(2)}}};
  const Reconstructed made = solid(slices);
  ASSERT_EQ(made.slabs.size(), 3U);
  EXPECT_EQ(count(made), (Counts{{"birth overlap", 1},
                                 {"death overlap", 1},
                                 {"link overlap", 2},
                                 {"merge overlap", 1},
                                 {"split overlap", 1}}));
  const SlabReport& first = made.slabs[0];
  EXPECT_EQ(first.lower_slice, 0U);
  EXPECT_EQ(first.upper_slice, 1U);
  EXPECT_DOUBLE_EQ(first.wall_area, 16);
  EXPECT_GT(first.sheet_area, 4);
  EXPECT_DOUBLE_EQ(first.overlap, 16.0 / 20);
  ASSERT_EQ(first.links.size(), 2U);
  EXPECT_EQ(first.links[0].kind, LinkKind::link);
  EXPECT_DOUBLE_EQ(first.links[0].confidence, 1);
  EXPECT_EQ(first.links[1].kind, LinkKind::birth);
  EXPECT_TRUE(first.links[1].lower.empty());
  EXPECT_EQ(first.links[1].upper, (std::vector<ContourId>{{1, 1}}));
  EXPECT_EQ(first.links[1].upper_place, (cdt::Point{20, 0}));
  EXPECT_EQ(first.links[1].confidence, 0);
  EXPECT_NEAR(first.confidence, 16 / (16 + first.sheet_area), 1e-12);

  const LinkReport& split = made.slabs[1].links[0];
  EXPECT_EQ(split.kind, LinkKind::split);
  EXPECT_EQ(split.upper, (std::vector<ContourId>{{2, 0}, {2, 1}}));
  EXPECT_NEAR(split.overlap, 2.0 / 16, 1e-12);
}

TEST(LinkReport, TellsOfShiftsAndHoles) {
  const Reconstructed made = solid(moving_disc(4, 1.5));
  EXPECT_EQ(count(made), (Counts{{"link slide", 3}}));
  for (const SlabReport& slab : made.slabs) {
    const double way = std::hypot(1.5, 0.45);
    EXPECT_NEAR(slab.shift, way, 1e-5);
    EXPECT_NEAR(slab.overlap, 1, 0.01);
    EXPECT_NEAR(slab.confidence, 1 / (1 + way), 0.01);
  }
  std::vector<Slice> slices;
  for (int i = 0; i < 2; ++i) slices.push_back({double(i), {stacks::square(3), stacks::square(1)}});
  const Reconstructed pipe = solid(slices);
  ASSERT_EQ(pipe.slabs[0].links.size(), 2U);
  EXPECT_TRUE(pipe.slabs[0].links[0].is_solid);
  EXPECT_FALSE(pipe.slabs[0].links[1].is_solid);
  EXPECT_EQ(pipe.slabs[0].overlap, 1);
  EXPECT_EQ(pipe.slabs[0].sheet_area, 0);
}

}  // namespace
}  // namespace loft
