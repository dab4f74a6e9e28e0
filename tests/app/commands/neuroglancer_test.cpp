// SPDX-License-Identifier: MIT
// Meshes for Neuroglancer, by several jobs in one folder.
#include <gtest/gtest.h>

#include <list>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/app/many_labels.h"
#include "tests/app/running.h"

namespace loft::app {
namespace {

using namespace testing;

TEST(Neuroglancer, JobsAtTheSameTimeMakeTheFolderOfOne) {
  const Folder folder;
  static_cast<void>(folder.write("in.ndjson", many_labels(12, 4)));
  ASSERT_EQ(run(folder, "reconstruct in.ndjson -q -o precomputed://whole").exit_code, 0);
  std::list<Running> jobs;
  for (const std::string i : {"0/4", "1/4", "2/4", "3/4", "0/2", "1/2"})
    jobs.emplace_back(
        folder, std::vector<std::string>{"reconstruct", "in.ndjson", "-q", "-o", "parts/meshes",
                                         "--format", "neuroglancer", "--shard", i});
  for (Running& job : jobs) EXPECT_EQ(job.wait(), 0) << content(folder / "err.txt");
  const auto whole = files_in(folder / "whole");
  EXPECT_EQ(whole.size(), 2U + 2 * 12);
  EXPECT_EQ(files_in(folder / "parts/meshes"), whole);
}

TEST(Neuroglancer, MeshesAreValidSolidsInNanometres) {
  const Folder folder;
  static_cast<void>(folder.write("in.ndjson", many_labels(3, 4)));
  const auto made = nlohmann::json::parse(
      run(folder, "reconstruct in.ndjson --unit um --json -o precomputed://meshes").out);
  const Outcome checked = run(folder, "check precomputed://meshes --json");
  EXPECT_EQ(checked.exit_code, 0) << checked.out << checked.err;
  const auto parts = nlohmann::json::parse(checked.out);
  EXPECT_EQ(parts["parts"].size(), 3U) << checked.out;
  std::map<std::string, double> volumes;
  for (const auto& part : made["parts"]) volumes[part["label"]] = part["volume"];
  for (const auto& part : parts["parts"])
    EXPECT_NEAR(part["volume"].get<double>() / (volumes.at(part["label"]) * 1e9), 1, 1e-5);
}

TEST(Neuroglancer, WhatIsThereIsNotMadeAgain) {
  const Folder folder;
  static_cast<void>(folder.write("in.ndjson", many_labels(5, 4)));
  const std::string words = "reconstruct in.ndjson --json -q -o precomputed://meshes ";
  static_cast<void>(run(folder, words + "--shard 0/2"));
  const auto rest = nlohmann::json::parse(run(folder, words + "--skip-existing").out);
  EXPECT_EQ(rest["parts"].size() + rest["existing"].size(), 5U);
  EXPECT_FALSE(rest["existing"].empty());
  std::filesystem::remove(folder / "meshes/2:0");
  const auto again = nlohmann::json::parse(run(folder, words + "--skip-existing").out);
  EXPECT_EQ(again["parts"].size(), 1U);
  EXPECT_EQ(again["parts"][0]["label"], "cell 2");
}

// Both were replaced without a word.
TEST(Neuroglancer, AFolderOfSomethingElseOrOfAnotherStackIsLeftAlone) {
  const Folder folder;
  static_cast<void>(folder.write("in.ndjson", many_labels(3, 4)));
  static_cast<void>(folder.write("other.ndjson", many_labels(5, 4)));
  std::filesystem::create_directory(folder / "volume");
  const std::string volume = R"({"@type": "neuroglancer_multiscale_volume"})";
  static_cast<void>(folder.write("volume/info", volume));
  EXPECT_EQ(run(folder, "reconstruct in.ndjson -q -o precomputed://volume").exit_code, 4);
  EXPECT_EQ(content(folder / "volume/info"), volume);
  ASSERT_EQ(run(folder, "reconstruct in.ndjson -q -o precomputed://meshes").exit_code, 0);
  const auto before = files_in(folder / "meshes");
  const Outcome other =
      run(folder, "reconstruct other.ndjson -q -o precomputed://meshes --only 'cell 4'");
  EXPECT_EQ(other.exit_code, before == files_in(folder / "meshes") ? 4 : 0) << other.err;
  ASSERT_EQ(run(folder, "reconstruct in.ndjson -q -o precomputed://").exit_code, 2);
}

TEST(Neuroglancer, AFragmentNamedManyTimesIsReadNeverThatOften) {
  const Folder folder;
  static_cast<void>(folder.write("in.ndjson", barrel()));
  ASSERT_EQ(run(folder, "reconstruct in.ndjson -q -o precomputed://meshes").exit_code, 0);
  static_cast<void>(folder.write("meshes/1:0", R"({"fragments": ["1:0:1", "1:0:1"]})"));
  const Outcome checked = run(folder, "check precomputed://meshes");
  EXPECT_EQ(checked.exit_code, 3);
  EXPECT_NE(checked.err.find("twice"), std::string::npos) << checked.err;
}

TEST(Neuroglancer, AStackWithoutLabelsHasOneMesh) {
  const Folder folder;
  static_cast<void>(folder.write("in.ndjson", barrel()));
  EXPECT_EQ(run(folder, "reconstruct in.ndjson -q -o precomputed://meshes").exit_code, 0);
  EXPECT_TRUE(std::filesystem::exists(folder / "meshes/1:0:1"));
}

}  // namespace
}  // namespace loft::app
