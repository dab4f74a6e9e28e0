// SPDX-License-Identifier: MIT
// `loft reconstruct --slabs` in jobs, and `loft join`: the bytes of the whole.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

#include "tests/app/program.h"

namespace loft::app {
namespace {

using namespace testing;
using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr int heights = 13;

/// Two labels that wander, one from the third slice on, and one that is nothing.
std::string wanderers() {
  std::string stack;
  for (int z = 0; z < heights; ++z) {
    stack += R"({"z": )" + std::to_string(z) + R"(, "contours": [)" + ring(3, 9, 2.5 * z, 0) +
             (z > 1 ? ", " + ring(2 + 0.3 * (z % 4), 12, 0, z) : "") +
             R"(, [[0, 0]]], "labels": ["b")" + (z > 1 ? R"(, "a")" : "") + R"(, "dots"]})" + "\n";
  }
  return stack;
}

std::string part_name(int first) { return "p" + std::to_string(first) + ".ply"; }

Outcome make_part(const Folder& folder, int first, int bound, const std::string& options) {
  return run(folder, "reconstruct in.ndjson --slabs " + std::to_string(first) + ".." +
                         std::to_string(bound) + " -o " + part_name(first) + " -q " + options);
}

TEST(Ranges, JoinedAreTheWhole) {
  const Folder folder;
  static_cast<void>(folder.write("in.ndjson", wanderers()));
  std::mt19937_64 random(4);
  for (const std::string options :
       {"", "--smooth --cap dome", "--smooth-tolerance 0.05", "--cap extend --fair 0.1",
        "--link overlap --only 'a'", "--cap open --target-edge 2"}) {
    SCOPED_TRACE(options);
    ASSERT_EQ(run(folder, "reconstruct in.ndjson -o whole.ply " + options).exit_code, 0);
    std::vector<int> cuts{0};
    for (int slab = 1; slab + 1 < heights; ++slab)
      if (random() % 3 == 0) cuts.push_back(slab);
    cuts.push_back(heights - 1);
    std::string parts;
    for (std::size_t i = cuts.size() - 1; i-- > 0;) {
      const std::string threads = " --threads " + std::to_string(1 + i % 2);
      const Outcome made = make_part(folder, cuts[i], cuts[i + 1], options + threads);
      ASSERT_EQ(made.exit_code, 0) << made.err;
      parts += part_name(cuts[i]) + ' ';
    }
    const Outcome joined = run(folder, "join " + parts + "-o joined.ply --json");
    EXPECT_EQ(joined.exit_code, 0) << joined.err;
    EXPECT_TRUE(content(folder / "joined.ply") == content(folder / "whole.ply"));
    EXPECT_GT(nlohmann::json::parse(joined.out)["faces"], 0);
  }
}

/// Jobs that are killed leave no half part, and what they leave is in nobody's way.
TEST(Ranges, KilledJobsCanBeStartedAgain) {
  const Folder folder;
  std::string stack;
  for (int z = 0; z < 60; ++z) stack += slice(z, ring(20, 1500, 0.3 * z, 0));
  static_cast<void>(folder.write("in.ndjson", stack));
  ASSERT_EQ(run(folder, "reconstruct in.ndjson -o whole.ply -q").exit_code, 0);
  const std::string program = std::getenv("LOFT");
  for (int i = 0; i < 12; ++i) {
    const std::string seconds = "0.0" + std::to_string(10 + 7 * i);
    static_cast<void>(
        std::system(("cd '" + (folder / "").string() + "' && timeout -s KILL " + seconds + " '" +
                     program + "' reconstruct in.ndjson --slabs 0..30 -o p0.ply -q 2>/dev/null")
                        .c_str()));
    if (!std::filesystem::exists(folder / "p0.ply")) continue;
    EXPECT_THAT(run(folder, "join p0.ply -o x.ply").err, HasSubstr("no part has the slabs 30..59"));
  }
  ASSERT_EQ(make_part(folder, 0, 30, "").exit_code, 0);
  ASSERT_EQ(make_part(folder, 30, 59, "").exit_code, 0);
  ASSERT_EQ(run(folder, "join p30.ply p0.ply -o joined.ply -q").exit_code, 0);
  EXPECT_TRUE(content(folder / "joined.ply") == content(folder / "whole.ply"));
}

TEST(Ranges, WhatDoesNotFitIsRefused) {
  const Folder folder;
  static_cast<void>(folder.write("in.ndjson", wanderers()));
  ASSERT_EQ(make_part(folder, 0, 5, "").exit_code, 0);
  ASSERT_EQ(make_part(folder, 5, 12, "--smooth").exit_code, 0);
  const Outcome options = run(folder, "join p0.ply p5.ply -o x.ply");
  EXPECT_EQ(options.exit_code, 3);
  EXPECT_THAT(options.err, HasSubstr("p5.ply was made with other options than p0.ply: smooth yes, "
                                     "not no"));
  static_cast<void>(folder.write("in.ndjson", wanderers() + slice(40, ring(3))));
  ASSERT_EQ(make_part(folder, 5, 13, "").exit_code, 0);
  const Outcome stacks = run(folder, "join p0.ply p5.ply in.ndjson -o x.ply");
  EXPECT_EQ(stacks.exit_code, 3);
  EXPECT_THAT(stacks.err, AllOf(HasSubstr("p5.ply is of another stack than p0.ply"),
                                HasSubstr("in.ndjson: is no part")));
  EXPECT_FALSE(std::filesystem::exists(folder / "x.ply"));
  EXPECT_EQ(run(folder, "join p0.ply -o p0.ply").exit_code, 2);
  EXPECT_EQ(run(folder, "join p0.ply -o x.stl").exit_code, 2);
}

TEST(Ranges, SayWhatTheyCannotDo) {
  const Folder folder;
  static_cast<void>(folder.write("in.ndjson", barrel()));
  const auto complaint = [&](const std::string& arguments) {
    const Outcome outcome = run(folder, "reconstruct in.ndjson " + arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments;
    return outcome.err;
  };
  EXPECT_THAT(complaint("-o a.ply --slabs 2..9"), HasSubstr("the stack has the slabs 0..4"));
  EXPECT_THAT(complaint("-o a.ply --slabs 4.."), HasSubstr("the stack has the slabs 0..4"));
  for (const std::string wrong : {"3", "3..3", "4..2", "..", "-1..2", "a..b", "1..2x", "1...2"})
    EXPECT_THAT(complaint("-o a.ply --slabs=" + wrong), HasSubstr("no range of slabs"));
  EXPECT_THAT(complaint("-o a.glb --slabs 0..2"), HasSubstr("one PLY file"));
  EXPECT_THAT(complaint("-o a.ply --slabs 0..2 --in-memory"), HasSubstr("--in-memory"));
  EXPECT_THAT(complaint("-o a.ply --slabs 0..2 --simplify 1"), HasSubstr("--simplify"));
  EXPECT_THAT(complaint("-o a.ply --slabs 0..2 --csv v.csv"), HasSubstr("--csv"));
}

TEST(Ranges, ReportWhatTheyAre) {
  const Folder folder;
  static_cast<void>(folder.write("in.ndjson", barrel(slice(2, ring(10) + "," + ring(10)))));
  const Outcome low = run(folder, "reconstruct in.ndjson --slabs ..2 -o a.ply --json --list-slabs");
  const auto report = nlohmann::json::parse(low.out);
  EXPECT_EQ(report["slabs"], "0..2");
  EXPECT_TRUE(report["parts"][0]["volume"].is_null());
  EXPECT_EQ(report["parts"][0]["slabs"].size(), 2U);
  EXPECT_EQ(report["parts"][0]["repairs"].size(), 0U);  // of the slice 2, which is another's
  const Outcome high = run(folder, "reconstruct in.ndjson --slabs 2.. -o b.ply --json");
  EXPECT_EQ(nlohmann::json::parse(high.out)["parts"][0]["repairs"].size(), 1U);
  EXPECT_THAT(high.err, HasSubstr("the slabs 2..4"));
}

}  // namespace
}  // namespace loft::app
