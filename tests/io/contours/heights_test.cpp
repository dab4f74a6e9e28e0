// SPDX-License-Identifier: MIT
#include "io/contours/heights.h"

#include <gtest/gtest.h>

#include "io/contours/edge_loops.h"
#include "io/contours/stack_builder.h"
#include "reconstruct/defect.h"

namespace loft::io {
namespace {

TEST(HeightGroups, BringHeightsTogetherThatDifferByRounding) {
  const HeightGroups groups({36.000003814697266, 36, 38, 1.97e-06, 0, 36, 40});
  EXPECT_EQ(groups.of(36.000003814697266), 36);  // the one that most have
  EXPECT_EQ(groups.of(1.97e-06), 0);             // the lowest of those
  EXPECT_EQ(groups.of(38), 38);
}

TEST(HeightGroups, KeepUnevenGaps) {
  const HeightGroups groups({-99.48, -98.23, 103.02, 104.27});
  for (const double z : {-99.48, -98.23, 103.02, 104.27}) EXPECT_EQ(groups.of(z), z);
}

TEST(HeightGroups, FindTheGapWhereMostDifferencesAreRounding) {
  std::vector<double> heights;
  for (int slice = 0; slice < 5; ++slice)
    for (int k = 0; k < 4; ++k) heights.push_back(3 * slice + k * 1e-7);
  const HeightGroups groups(heights);
  EXPECT_EQ(groups.of(6 + 3e-7), 6);
  EXPECT_DOUBLE_EQ(groups.tolerance(), 0.01 * (3 - 3e-7));
}

TEST(HeightGroups, KeepThinSlicesFarFromTheOrigin) {
  const HeightGroups groups({500'000, 500'000.1, 500'000.2});
  EXPECT_EQ(groups.of(500'000.1), 500'000.1);
}

TEST(HeightGroups, LeaveOtherHeightsAlone) {
  EXPECT_EQ(HeightGroups({}).of(3), 3);
  EXPECT_EQ(HeightGroups({1, 2}).of(1.5), 1.5);
  EXPECT_EQ(HeightGroups({1, 2}).of(9), 9);
}

const Contour unit_square{{{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}}, "a"};

TEST(StackBuilder, MakesAscendingSlicesOfClosedContours) {
  StackBuilder builder("a.file");
  builder.add(unit_square, 2);
  builder.add(unit_square, 1, 1.0000001);  // level but for rounding
  builder.add(unit_square, 0, 1);          // in no plane
  builder.add({{{0, 0}, {1, 1}}, "a"}, 1);
  builder.add_height(3);
  builder.skip("b", "open line", 2);
  Stack stack;
  builder.finish(stack, "advice");
  ASSERT_EQ(stack.slices.size(), 3U);
  EXPECT_EQ(stack.slices[0].z, 1);
  EXPECT_EQ(stack.slices[0].contours.size(), 1U);
  EXPECT_EQ(stack.slices[1].contours[0].points.size(), 4U);  // the first is not repeated
  EXPECT_TRUE(stack.slices[2].contours.empty());
  EXPECT_EQ(stack.notes, (std::vector<std::string>{"label 'a': 1 contour of 1 or 2 points, 1 "
                                                   "contour that is in no plane left out",
                                                   "label 'b': 2 open lines left out"}));
}

TEST(StackBuilder, SaysWhatThereWasWhereNothingIsLeft) {
  StackBuilder builder("a.file");
  builder.skip("a", "open line", 900);
  builder.skip("b", "open line", 10);
  Stack stack;
  try {
    builder.finish(stack, "do that.");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "a.file: no closed outline in it, only 910 open lines; do that.");
  }
}

using Loops = std::vector<std::vector<std::uint32_t>>;

TEST(JoinEdges, MakesLoopsOfEdgesInAnyOrderAndDirection) {
  const EdgeLoops result = join_edges({{{0, 1}, {3, 2}, {3, 0}, {1, 2}}});
  EXPECT_EQ(result.loops, (Loops{{0, 1, 2, 3}}));
  EXPECT_EQ(result.open_lines, 0U);
}

TEST(JoinEdges, PartsLoopsThatMeetInAVertex) {
  const EdgeLoops result = join_edges({{{0, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 2}, {2, 0}}});
  EXPECT_EQ(result.loops, (Loops{{2, 3, 4}, {0, 1, 2}}));
}

TEST(JoinEdges, CountsLinesThatEnd) {
  const EdgeLoops result = join_edges({{{0, 1}, {1, 2}, {3, 4}, {4, 5}, {5, 3}}});
  EXPECT_EQ(result.loops, (Loops{{3, 4, 5}}));
  EXPECT_EQ(result.open_lines, 1U);
}

}  // namespace
}  // namespace loft::io
