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
