// SPDX-License-Identifier: MIT
#include "reconstruct/clean/outline_depths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>

#include "reconstruct/clean/simple_slice.h"
#include "tests/reconstruct/stacks.h"

namespace loft {
namespace {

using cdt::Point;

/// By the smallest places that are inside: outlines within a square, each in a part of it.
struct Nest {
  std::vector<Contour> contours;
  std::vector<OutlineDepth> depths;
  std::vector<bool> turns_left;
};

/// A square of that size, on its corner or not, with others in it.
void fill(Nest& nest, std::mt19937_64& random, Point middle, double size, OutlineDepth around) {
  if (size < 0.01) return;
  Contour outline = random() % 2 == 0 ? stacks::square(size, middle)
                                      : stacks::circle(3 + random() % 5, size, middle);
  const bool is_left = random() % 2 == 0;
  if (!is_left) std::ranges::reverse(outline.points);
  std::ranges::rotate(outline.points, outline.points.begin() + static_cast<long>(random() % 3));
  nest.contours.push_back(outline);
  nest.depths.push_back(around);
  nest.turns_left.push_back(is_left);
  const OutlineDepth inside{around.depth + 1, around.winding + (is_left ? 1 : -1)};
  const std::size_t children = random() % 3;
  if (children == 1) fill(nest, random, middle, size / 3, inside);
  if (children == 2)
    for (const double side : {-0.2, 0.2})
      fill(nest, random, {middle.x + side * size, middle.y}, size / 9, inside);
}

TEST(OutlineDepths, AreHowManyOutlinesEncloseEachAndHowTheyTurn) {
  int deepest = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    Nest nest;
    for (int i = 0; i < 4; ++i) fill(nest, random, {50.0 * i, 7.0 * (i % 2)}, 20, {});
    std::vector<SimpleOutline> outlines;
    for (std::size_t i = 0; i < nest.contours.size(); ++i)
      outlines.push_back({nest.contours[i].points, nest.turns_left[i]});
    const std::vector<OutlineDepth> found = outline_depths(outlines);
    ASSERT_EQ(found.size(), nest.depths.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_EQ(found[i].depth, nest.depths[i].depth) << i;
      EXPECT_EQ(found[i].winding, nest.depths[i].winding) << i;
      deepest = std::max(deepest, found[i].depth);
    }
  }
  EXPECT_GT(deepest, 3);
}

// Each box of an edge meets all others: the slice went the long way, by a triangulation.
TEST(SimpleSlice, HundredsOfNestedDiamondsAreSimpleUnlessTwoMeet) {
  std::vector<Contour> diamonds;
  for (int i = 0; i < 400; ++i) diamonds.push_back(stacks::circle(4, 1.0 + i));
  const auto is_simple = [&] {
    std::vector<ContourSource> contours;
    for (std::uint32_t c = 0; c < diamonds.size(); ++c)
      contours.push_back({diamonds[c].points, 0, c});
    const auto region = simple_region(contours, 0, Fill::even_odd, 1e-9);
    return region && region->loop_count() == diamonds.size();
  };
  EXPECT_TRUE(is_simple());
  diamonds[200].points[1].y += 1.5;
  EXPECT_FALSE(is_simple());
  diamonds[200] = stacks::circle(4, 200.0 + 1e-9);  // nearly the one within it
  EXPECT_FALSE(is_simple());
}

}  // namespace
}  // namespace loft
