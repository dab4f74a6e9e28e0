// SPDX-License-Identifier: MIT
// What becomes of the labels in a stack, and of stacks in several files.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "tests/app/program.h"

namespace loft::app {
namespace {

using namespace testing;

std::string labelled(double z, const std::string& contours, const std::string& labels) {
  std::string line = slice(z, contours);
  line.insert(line.find_last_of('}'), ", \"labels\": [" + labels + "]");
  return line;
}

/// A body in three slices; `seed` is in the last one alone, or of two points.
std::string with_seed(const std::string& seed) {
  return labelled(0, ring(2), R"("body")") + labelled(1, ring(2), R"("body")") +
         labelled(2, ring(2) + ", " + seed, R"("body", "seed")");
}

TEST(Labels, OneOfWhichNothingCanBeMadeStopsNoOther) {
  const Folder folder;
  static_cast<void>(folder.write("in.ndjson", with_seed("[[9,9],[10,9]]")));
  for (const std::string how : {"", " --out-of-core"}) {
    const Outcome made = run(folder, "reconstruct in.ndjson -o out.ply --json" + how);
    EXPECT_EQ(made.exit_code, 0) << made.err;
    EXPECT_NE(made.err.find("label 'seed'"), std::string::npos) << made.err;
    const auto report = nlohmann::json::parse(made.out);
    EXPECT_EQ(report["skipped"][0]["label"], "seed");
    EXPECT_EQ(report["parts"].size(), 1U);
    EXPECT_EQ(run(folder, "check out.ply").exit_code, 0);
    const Outcome strict = run(folder, "reconstruct in.ndjson -o out.ply --strict" + how);
    EXPECT_EQ(strict.exit_code, 3);
    EXPECT_EQ(run(folder, "check out.ply").exit_code, 0) << "the others are written";
  }
}

TEST(Labels, SkippedOnesGiveTheSameFileOutOfCore) {
  const Folder folder;
  static_cast<void>(folder.write("in.ndjson", with_seed("[[9,9],[10,9]]")));
  static_cast<void>(run(folder, "reconstruct in.ndjson -o a.ply -q"));
  static_cast<void>(run(folder, "reconstruct in.ndjson -o b.ply -q --out-of-core"));
  EXPECT_FALSE(content(folder / "a.ply").empty());
  EXPECT_EQ(content(folder / "a.ply"), content(folder / "b.ply"));
}

TEST(Labels, IfNothingCanBeMadeOfAnyNothingIsWritten) {
  const Folder folder;
  static_cast<void>(folder.write("in.ndjson", labelled(0, ring(2), R"("a")")));
  EXPECT_EQ(run(folder, "reconstruct in.ndjson -o out.ply").exit_code, 3);
  EXPECT_FALSE(std::filesystem::exists(folder / "out.ply"));
}

TEST(SeveralFiles, AreStructuresOfTheirOwnUnlessMerged) {
  const Folder folder;
  static_cast<void>(folder.write("skin.ndjson", slice(0, ring(3)) + slice(1, ring(3))));
  static_cast<void>(folder.write("bone.ndjson", slice(0, ring(1)) + slice(1, ring(1))));
  for (const std::string how : {"", " --out-of-core"}) {
    const std::string files = "skin.ndjson bone.ndjson -o out.ply --json" + how;
    const auto apart = nlohmann::json::parse(run(folder, "reconstruct " + files).out);
    ASSERT_EQ(apart["parts"].size(), 2U);
    EXPECT_EQ(apart["parts"][0]["label"], "bone");
    EXPECT_EQ(apart["parts"][1]["label"], "skin");
    const auto merged = nlohmann::json::parse(run(folder, "reconstruct --merge " + files).out);
    ASSERT_EQ(merged["parts"].size(), 1U);
    EXPECT_EQ(merged["parts"][0]["genus"], 1);
  }
}

TEST(SeveralFiles, OfOneNameAreLabelledByTheirPaths) {
  const Folder folder;
  for (const char* name : {"a", "b"}) {
    std::filesystem::create_directory(folder / name);
    static_cast<void>(folder.write(std::string(name) + "/x.ndjson", barrel()));
  }
  const auto made =
      nlohmann::json::parse(run(folder, "reconstruct a/x.ndjson b/x.ndjson -o o.glb --json").out);
  ASSERT_EQ(made["parts"].size(), 2U);
  EXPECT_EQ(made["parts"][0]["label"], "a/x.ndjson");
}

TEST(Stl, OfSeveralLabelsIsRefusedWithTheWaysOut) {
  const Folder folder;
  static_cast<void>(
      folder.write("in.ndjson", labelled(0, ring(3) + "," + ring(1), R"("a", "b")") +
                                    labelled(1, ring(3) + "," + ring(1), R"("a", "b")")));
  const Outcome made = run(folder, "reconstruct in.ndjson -o out.stl");
  EXPECT_EQ(made.exit_code, 2);
  EXPECT_NE(made.err.find(".glb, .ply or .obj"), std::string::npos) << made.err;
  EXPECT_FALSE(std::filesystem::exists(folder / "out.stl"));
}

}  // namespace
}  // namespace loft::app
