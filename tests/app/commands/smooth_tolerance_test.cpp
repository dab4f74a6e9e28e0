// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "tests/app/program.h"

namespace loft::app {
namespace {

using namespace testing;
using ::testing::HasSubstr;

std::string round_stack() {
  return slice(0, ring(1, 40)) + slice(1, ring(2.5, 40)) + slice(2, ring(2.8, 40)) +
         slice(3, ring(1.5, 40));
}

int triangles(const Folder& folder, const std::string& options) {
  const Outcome made = run(folder, "reconstruct in.ndjson -o a.ply --json " + options);
  EXPECT_EQ(made.exit_code, 0) << made.err;
  const auto report = nlohmann::json::parse(made.out);
  EXPECT_EQ(report["options"]["smooth"], !options.empty());
  return report["parts"][0]["faces"];
}

TEST(SmoothTolerance, MeansSmoothAndTheLargerTheFewerTriangles) {
  const Folder folder;
  static_cast<void>(folder.write("in.ndjson", round_stack()));
  const int straight = triangles(folder, "");
  const int usual = triangles(folder, "--smooth");
  EXPECT_EQ(triangles(folder, "--smooth-tolerance 0"), usual);
  EXPECT_GT(triangles(folder, "--smooth-tolerance 0.001"), usual);
  EXPECT_LT(triangles(folder, "--smooth --smooth-tolerance 0.05"), usual);
  EXPECT_EQ(triangles(folder, "--smooth-tolerance 10"), straight);
}

TEST(SmoothTolerance, BadOnesAreRefused) {
  const Folder folder;
  static_cast<void>(folder.write("in.ndjson", round_stack()));
  for (const std::string distance : {"-1", "nan", "much"}) {
    const Outcome refused =
        run(folder, "reconstruct in.ndjson -o a.ply --smooth-tolerance " + distance);
    EXPECT_EQ(refused.exit_code, 2) << distance;
    EXPECT_THAT(refused.err, HasSubstr("is no distance"));
  }
}

TEST(SmoothTolerance, ASessionKeepsItsOwn) {
  const Folder folder;
  static_cast<void>(folder.write("in.ndjson", round_stack()));
  const std::string options = " --session s -o b.ply --smooth-tolerance 0.05";
  ASSERT_EQ(run(folder, "stream in.ndjson" + options).exit_code, 0);
  EXPECT_THAT(run(folder, "stream --no-input --session s --smooth-tolerance 0.1").err,
              HasSubstr("begun with smooth_tolerance 0.05"));
}

}  // namespace
}  // namespace loft::app
