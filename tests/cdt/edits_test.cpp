// SPDX-License-Identifier: MIT
#include "tests/cdt/edits.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <iterator>
#include <stdexcept>
#include <string>

#include "tests/cdt/judge.h"
#include "tests/cdt/random_edits.h"

namespace loft::cdt {
namespace {

constexpr std::uint64_t first_seed = 20240901;

/// Judges so many random scripts on one ground and prints how it went.
Tally judge_scripts(Ground ground, std::size_t scripts, std::size_t edits, std::size_t population,
                    Judging judging) {
  Tally tally;
  for (std::uint64_t seed = first_seed; seed < first_seed + scripts; ++seed) {
    const Script script = random_script(seed, ground, edits, population);
    const std::string words = verdict(script, judging, tally);
    EXPECT_TRUE(words.empty()) << name_of(ground) << ", seed " << seed << ": " << words;
    if (!words.empty()) break;
  }
  std::cout << name_of(ground) << ": " << tally << std::endl;
  return tally;
}

class Edits : public testing::TestWithParam<Ground> {};

/// On grids nothing is within rounding of anything else. Elsewhere rounding may leave no answer to
/// the reference, but hardly ever, and then it is reported.
void expect_few_snaps(const Tally& tally, Ground ground) {
  EXPECT_LE(tally.not_as_fresh, tally.same_as_fresh / 1000);
  EXPECT_LE(tally.not_embeddable, tally.same_as_reference / 1000);
  if (is_grid(ground)) {
    EXPECT_EQ(tally.snapped_in_vain + tally.not_embeddable, 0U);
  }
}

TEST_P(Edits, LeaveWhatTheReferenceSays) {
  expect_few_snaps(judge_scripts(GetParam(), 40, 25, 4, {1, 60}), GetParam());
}

TEST_P(Edits, OfManyConstraintsLeaveWhatAFreshTriangulationHas) {
  expect_few_snaps(judge_scripts(GetParam(), 4, 200, 14, {10, 60}), GetParam());
}

INSTANTIATE_TEST_SUITE_P(, Edits, testing::ValuesIn(all_grounds), [](const auto& chosen) {
  std::string name = name_of(chosen.param);
  std::erase_if(name, [](char c) { return c == ' ' || c == '-'; });
  return name;
});

// Two segments cross a third one at places that differ in their last digits only. By the first,
// that one is bent so much that the other comes to the wrong one of its two halves.
TEST(Crossings, KeepTheOrderOfCoordinatesWhereAnotherHasBentTheSegment) {
  Tally tally;
  EXPECT_EQ(verdict(read_script("insert 0 open 2.0000000000000515 8e-14 "
                                "4.52e-14 1.0000000000000884 1.0000000000000666 1.0000000000000078 "
                                "2.0000000000000004 4.83e-14 5.73e-14 2.000000000000031"),
                    {1, 100}, tally),
            "");
}

TEST(Crossings, KeepTheOrderOfCoordinatesWhereAMovedSegmentIsAlmostParallel) {
  Tally tally;
  EXPECT_EQ(verdict(read_script("insert 0 open 80 240\n"
                                "insert 1 closed 6.800000000000001e-15 -2.3999999999999984e-15 "
                                "3.3999999999999995 -1.2000000000000004 "
                                "-1.7000000000000008e-15 5.999999999999994e-16\n"
                                "move 0 0 -1.4000000000000003e-15 113.33333333333344 "
                                "-39.999999999999964\n"
                                "translate 0 -2.3499999999999976e-15 3.000000000000001e-16"),
                    {1, 100}, tally),
            "");
}

// A crossing has bent the segment so that it had to lead through (0, 0), which is not near there.
TEST(Snaps, GoWithTheCrossingThatMadeThem) {
  Tally tally;
  EXPECT_EQ(verdict(read_script("insert 0 open -2.3999999999999972 -7.199999999999995\n"
                                "move 0 -1.799999999999999 -5.400000000000002 "
                                "2.3999999999999988e-15 7.200000000000003e-15\n"
                                "insert 1 closed -2.400000000000001 -7.199999999999994\n"
                                "move 1 -63.4 14.5 -12.6 -26.1 -40.8 32.5 -40.8 -32.5 -12.6 26.1\n"
                                "remove 1\n"
                                "insert 2 open 1.2000000000000006e-15 3.5999999999999985e-15 "
                                "0 1.4000000000000007e-15 2.400000000000004 7.200000000000006\n"
                                "insert 3 closed 0 0\n"
                                "remove 2"),
                    {1, 100}, tally),
            "");
}

/// The number of edits of the long run: `ctest -L soak` sets it.
std::size_t soak_edits() {
  const char* edits = std::getenv("LOFT_SOAK_EDITS");
  return edits == nullptr ? 6000 : std::stoul(edits);
}

TEST(Soak, LeavesWhatAFreshTriangulationHas) {
  constexpr std::size_t script_size = 1000;
  const std::size_t scripts = soak_edits() / script_size / std::size(all_grounds);
  for (const Ground ground : all_grounds)
    expect_few_snaps(
        judge_scripts(ground, std::max<std::size_t>(scripts, 1), script_size, 12, {100, 100}),
        ground);
}

TEST(EditScript, IsReadBackExactly) {
  for (const Ground ground : all_grounds) {
    const Script script = random_script(first_seed, ground, 50, 5);
    EXPECT_EQ(read_script(as_text(script)), script) << name_of(ground);
  }
  EXPECT_THROW((void)read_script("insert 1 ajar 0 0"), std::invalid_argument);
  EXPECT_THROW((void)read_script("insert 1 open"), std::invalid_argument);
  EXPECT_THROW((void)read_script("translate 1 0"), std::invalid_argument);
  EXPECT_THROW((void)read_script("remove one"), std::invalid_argument);
}

TEST(EditScript, PrintsAsStatements) {
  EXPECT_EQ(as_code(read_script("insert 3 closed 0 0 4 0 0.5 4\nmove 3 1 1\ntranslate 3 1 0\n"
                                "remove 3")),
            "Triangulation mesh;\n"
            "ConstraintId c3;\n"
            "c3 = mesh.insert(std::vector<Point>{{0, 0}, {4, 0}, {0.5, 4}}, closed);\n"
            "mesh.move(c3, std::vector<Point>{{1, 1}});\n"
            "mesh.translate(c3, {1, 0});\n"
            "mesh.remove(c3);\n");
}

TEST(EditScript, IsUndoneByTheInverseOfItsEdits) {
  for (const Ground ground : all_grounds) {
    Constraints constraints;
    for (const Edit& edit : random_script(first_seed, ground, 200, 5)) {
      ASSERT_TRUE(applies(edit, constraints));
      const Constraints before = constraints;
      carry_out(edit, constraints);
      Constraints undone = constraints;
      carry_out(inverse(edit, before), undone);
      EXPECT_EQ(undone, before);
    }
  }
}

}  // namespace
}  // namespace loft::cdt
