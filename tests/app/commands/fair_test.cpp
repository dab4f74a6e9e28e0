// SPDX-License-Identifier: MIT
// `--fair` of reconstruct, stream and convert, and what check makes of it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "tests/app/program.h"

namespace loft::app {
namespace {

using namespace testing;
using ::testing::HasSubstr;
using ::testing::Not;

/// Five slices of a disc along the edges of pixels.
std::string pixel_stack() {
  const auto width = [](int row) {
    return static_cast<int>(std::sqrt(144 - (row + 0.5) * (row + 0.5)));
  };
  std::ostringstream points;
  for (int row = -12; row < 12; ++row)
    points << '[' << width(row) << ',' << row << "],[" << width(row) << ',' << row + 1 << "],";
  for (int row = 11; row >= -12; --row)
    points << '[' << -width(row) << ',' << row + 1 << "],[" << -width(row) << ',' << row
           << (row == -12 ? "]" : "],");
  std::string stack;
  for (int z = 0; z < 5; ++z) stack += slice(z, '[' + points.str() + ']');
  return stack;
}

TEST(Fair, SurfacesAreWithinTheDistanceOfTheirStack) {
  const Folder folder;
  static_cast<void>(folder.write("in.ndjson", pixel_stack()));
  const Outcome made = run(folder, "reconstruct in.ndjson --fair 0.75 -o a.ply --json");
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_EQ(nlohmann::json::parse(made.out)["options"]["fair"], 0.75);
  EXPECT_EQ(run(folder, "check a.ply --stack in.ndjson").exit_code, 1);
  EXPECT_EQ(run(folder, "check a.ply --stack in.ndjson --within 0.2").exit_code, 1);
  const Outcome checked = run(folder, "check a.ply --stack in.ndjson --within 0.75");
  EXPECT_EQ(checked.exit_code, 0) << checked.out;
  EXPECT_THAT(checked.out, HasSubstr("within 0.75"));
  // What convert writes is in the surface, exactly.
  ASSERT_EQ(run(folder, "convert in.ndjson --fair 0.75 -o fair.ndjson").exit_code, 0);
  EXPECT_EQ(run(folder, "check a.ply --stack fair.ndjson").exit_code, 0);
}

TEST(Fair, IsTheSameInMemoryOutOfCoreAndInAStream) {
  const Folder folder;
  static_cast<void>(folder.write("in.ndjson", pixel_stack()));
  const std::string options = " in.ndjson --fair 0.6 ";
  ASSERT_EQ(run(folder, "reconstruct" + options + "-o a.ply --threads 1").exit_code, 0);
  ASSERT_EQ(run(folder, "reconstruct" + options + "-o b.ply --out-of-core").exit_code, 0);
  ASSERT_EQ(run(folder, "stream" + options + "-o c.ply --session s").exit_code, 0);
  EXPECT_TRUE(content(folder / "a.ply") == content(folder / "b.ply"));
  const auto volume = [&](const std::string& file) {
    return nlohmann::json::parse(run(folder, "info --json " + file).out)["volume"];
  };
  EXPECT_EQ(volume("c.ply"), volume("a.ply"));
  // The session knows.
  EXPECT_EQ(run(folder, "stream --no-input --session s -o d.ply").exit_code, 0);
  EXPECT_TRUE(content(folder / "c.ply") == content(folder / "d.ply"));
  EXPECT_THAT(run(folder, "stream --no-input --session s --fair 0.5").err,
              HasSubstr("begun with fair 0.6"));
}

TEST(Fair, StairsThatWouldBeBentAreNamed) {
  const Folder folder;
  static_cast<void>(folder.write("in.ndjson", pixel_stack()));
  static_cast<void>(folder.write("round.ndjson", barrel()));
  EXPECT_THAT(run(folder, "reconstruct in.ndjson --smooth -o a.ply").err, HasSubstr("--fair"));
  EXPECT_THAT(run(folder, "reconstruct in.ndjson --smooth --out-of-core -o a.ply").err,
              HasSubstr("--fair"));
  for (const std::string quiet :
       {"in.ndjson", "in.ndjson --smooth --fair 1", "round.ndjson --smooth"})
    EXPECT_THAT(run(folder, "reconstruct " + quiet + " -o a.ply").err, Not(HasSubstr("stairs")));
}

TEST(Fair, DistancesThatAreNoneAreRefused) {
  const Folder folder;
  static_cast<void>(folder.write("in.ndjson", barrel()));
  for (const std::string distance : {"-1", "nan", "wide"})
    EXPECT_EQ(run(folder, "reconstruct in.ndjson -o a.ply --fair " + distance).exit_code, 2);
}

TEST(Fair, OutlinesOfMasksAreCheckedAsTheyAreDrawn) {
  const Folder folder;
  static_cast<void>(
      folder.write("in.nrrd",
                   "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 4 4 2\nspacings: 1 1 1\nencoding: "
                   "ascii\n\n0 0 0 0 0 1 1 0 0 1 1 0 0 0 1 0 0 0 0 0 0 1 1 0 0 1 1 0 0 0 0 0\n"));
  ASSERT_EQ(run(folder, "reconstruct in.nrrd --outline fair -o a.ply").exit_code, 0);
  EXPECT_EQ(run(folder, "check a.ply --stack in.nrrd --outline fair").exit_code, 0);
  EXPECT_EQ(run(folder, "check a.ply --stack in.nrrd").exit_code, 1);
}

}  // namespace
}  // namespace loft::app
