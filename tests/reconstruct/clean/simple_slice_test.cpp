// SPDX-License-Identifier: MIT
#include "reconstruct/clean/simple_slice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "reconstruct/clean/cleaning.h"
#include "tests/reconstruct/stacks.h"

namespace loft {
namespace {

std::vector<ContourSource> sources(const Slice& slice) {
  std::vector<ContourSource> result;
  for (std::uint32_t c = 0; c < slice.contours.size(); ++c)
    result.push_back({slice.contours[c].points, 0, c});
  return result;
}

/// The loops, each from its smallest point on, in any order.
std::set<std::vector<cdt::Point>> loops(const Region& region) {
  std::set<std::vector<cdt::Point>> result;
  for (std::size_t i = 0; i < region.loop_count(); ++i) {
    std::vector<cdt::Point> loop;
    for (const std::uint32_t v : region.loop(i)) loop.push_back(region.points[v]);
    std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
    result.insert(loop);
  }
  return result;
}

/// Discs and squares here and there, in any direction; some meet, most do not.
Slice scattered(std::mt19937_64& random) {
  std::uniform_real_distribution<double> anywhere(0, 100);
  Slice slice{0, {}};
  const std::size_t count = 1 + random() % 8;
  for (std::size_t i = 0; i < count; ++i) {
    const cdt::Point centre{anywhere(random), anywhere(random)};
    const double size = 1 + anywhere(random) / 4;
    slice.contours.push_back(random() % 4 == 0 ? stacks::square(size, centre)
                                               : stacks::circle(3 + random() % 40, size, centre));
    if (random() % 3 == 0) slice.contours.push_back(stacks::circle(20, size / 2, centre));
    for (Contour& contour : slice.contours)
      if (random() % 2 == 0) std::ranges::reverse(contour.points);
  }
  return slice;
}

// Keyhole-aware filling without a width is even-odd filling by way of the triangulation.
TEST(SimpleSlice, IsWhatCleaningMakesOfIt) {
  int simple = 0;
  for (std::uint64_t seed = 0; seed < 500; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    const Slice slice =
        seed % 4 == 3 ? stacks::random_slice(0, random, seed % 8 == 3) : scattered(random);
    const auto contours = sources(slice);
    const auto region = simple_region(contours, 0, Fill::even_odd, 1e-9);
    std::vector<Defect> repairs;
    const Region cleaned = clean(contours, 0, {Fill::keyhole_aware, 0.0}, repairs);
    if (!region) continue;
    ++simple;
    EXPECT_TRUE(repairs.empty());
    EXPECT_EQ(loops(*region), loops(cleaned));
    for (std::size_t i = 0; i < region->points.size(); ++i) {
      const Origin& origin = region->origins[i];
      EXPECT_EQ(origin.kind, VertexKind::contour);
      EXPECT_EQ(slice.contours[origin.contour].points[origin.point], region->points[i]);
    }
  }
  EXPECT_GT(simple, 100);
}

TEST(SimpleSlice, DoesNotDependOnTheOrderOfContours) {
  std::mt19937_64 random(1);
  Slice slice{0, {stacks::circle(30, 10), stacks::circle(20, 5), stacks::square(2, {20, 3})}};
  const auto first = simple_region(sources(slice), 0, Fill::even_odd, 1e-9);
  std::ranges::reverse(slice.contours);
  for (Contour& contour : slice.contours)
    std::rotate(contour.points.begin(), contour.points.begin() + 1, contour.points.end());
  const auto second = simple_region(sources(slice), 0, Fill::even_odd, 1e-9);
  ASSERT_TRUE(first && second);
  EXPECT_EQ(first->points, second->points);
  EXPECT_EQ(first->loop_starts, second->loop_starts);
}

TEST(SimpleSlice, LeavesAllElseToCleaning) {
  const Contour square = stacks::square(1);
  Contour spike = square;
  spike.points.insert(spike.points.begin() + 1, {{0, -1}, {0, -2}, {0, -1}});
  Contour twice = square;
  twice.points.insert(twice.points.begin(), twice.points.front());
  const Contour bow_tie{{{-1, -1}, {1, 1}, {1, -1}, {-1, 1}}, {}};
  const Contour flat{{{0, 0}, {1, 0}, {2, 0}}, {}};
  const Contour two{{{0, 0}, {1, 0}}, {}};
  const std::vector<Slice> dirty{{0, {spike}},
                                 {0, {twice}},
                                 {0, {bow_tie}},
                                 {0, {flat}},
                                 {0, {two}},
                                 {0, {square, square}},
                                 {0, {square, stacks::square(1, {0.5, 0.5})}},
                                 {0, {square, stacks::square(1, {2, 2})}},
                                 {0, {square, stacks::square(1, {2, 0.5})}},
                                 {0, {square, stacks::square(1, {2 + 1e-12, 0})}},
                                 {0, {square, stacks::square(0.5, {0.5, 0})}}};
  for (std::size_t i = 0; i < dirty.size(); ++i)
    EXPECT_FALSE(simple_region(sources(dirty[i]), 0, Fill::even_odd, 1e-9)) << i;
}

TEST(SimpleSlice, WindsByTheNonzeroRule) {
  Slice slice{0, {stacks::circle(30, 10), stacks::circle(20, 5)}};
  EXPECT_FALSE(simple_region(sources(slice), 0, Fill::nonzero, 1e-9));  // the inner one is covered
  std::ranges::reverse(slice.contours[1].points);
  const auto hole = simple_region(sources(slice), 0, Fill::nonzero, 1e-9);
  const auto same = simple_region(sources(slice), 0, Fill::even_odd, 1e-9);
  ASSERT_TRUE(hole && same);
  EXPECT_EQ(loops(*hole), loops(*same));
  for (Contour& contour : slice.contours) std::ranges::reverse(contour.points);
  const auto turned = simple_region(sources(slice), 0, Fill::nonzero, 1e-9);
  ASSERT_TRUE(turned);
  EXPECT_EQ(loops(*turned), loops(*same));
}

}  // namespace
}  // namespace loft
