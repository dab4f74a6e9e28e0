// SPDX-License-Identifier: MIT
#include "mesh/box_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

namespace loft {
namespace {

using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

/// Boxes of very different sizes, on a coarse lattice so that many only touch.
std::vector<Box3> random_boxes(std::mt19937& random, std::size_t count) {
  std::uniform_int_distribution place(0, 40);
  std::uniform_int_distribution size(0, 3);
  std::vector<Box3> boxes(count);
  for (Box3& box : boxes) {
    const int scale = size(random) == 0 ? 8 : 1;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      box.low[axis] = place(random);
      box.high[axis] = box.low[axis] + scale * size(random);
    }
  }
  return boxes;
}

TEST(BoxTree, FindsThePairsThatMeetEachOnce) {
  constexpr unsigned seed = 20;
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  for (const std::size_t count : {0U, 1U, 4U, 5U, 60U, 300U}) {
    const auto boxes = random_boxes(random, count);
    Pairs expected;
    for (std::uint32_t i = 0; i < count; ++i)
      for (std::uint32_t j = i + 1; j < count; ++j)
        if (boxes_meet(boxes[i], boxes[j])) expected.emplace_back(i, j);
    Pairs found;
    BoxTree(boxes).for_each_pair([&](std::uint32_t i, std::uint32_t j) {
      found.emplace_back(std::minmax({i, j}));
    });
    std::ranges::sort(found);
    EXPECT_EQ(found, expected) << count;
  }
}

TEST(BoxTree, StopsAtThePairThatFails) {
  const std::vector<Box3> same(50, Box3{{0, 0, 0}, {1, 1, 1}});
  int count = 0;
  EXPECT_FALSE(
      BoxTree(same).all_of_pairs([&](std::uint32_t, std::uint32_t) { return ++count < 7; }));
  EXPECT_EQ(count, 7);
  EXPECT_TRUE(BoxTree(same).all_of_pairs([](std::uint32_t, std::uint32_t) { return true; }));
}

}  // namespace
}  // namespace loft
