// SPDX-License-Identifier: MIT
// Jobs that share the labels of a stack.
#include "app/commands/shard.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>
#include <random>
#include <string>

#include "tests/app/many_labels.h"

namespace loft::app {
namespace {

using namespace testing;

std::vector<LabelSize> random_labels(std::mt19937& random) {
  std::vector<LabelSize> labels(random() % 60);
  for (std::size_t i = 0; i < labels.size(); ++i)
    labels[i] = {"label " + std::to_string(i), random() % (random() % 2 == 0 ? 5 : 1000)};
  return labels;
}

TEST(Shard, IsWhatItsTextSays) {
  ASSERT_TRUE(shard("3/7"));
  EXPECT_EQ(shard("3/7")->index, 3U);
  EXPECT_EQ(shard("3/7")->count, 7U);
  for (const char* bad : {"", "/", "7/7", "-1/7", "1/", "/7", "1/7x", "1 /7", "0/0", "1"}) {
    EXPECT_FALSE(shard(bad)) << bad;
    EXPECT_NE(complain_of_shard(bad).find("0/100 to 99/100"), std::string::npos);
  }
}

TEST(Shard, TogetherTheyHaveEachLabelOnceInWhateverOrderItComes) {
  std::mt19937 random(1);
  for (int round = 0; round < 200; ++round) {
    std::vector<LabelSize> labels = random_labels(random);
    const std::size_t count = 1 + random() % 9;
    std::map<std::string, std::size_t> times;
    for (std::size_t i = 0; i < count; ++i) {
      const std::vector<std::string> mine = dealt(labels, {i, count});
      EXPECT_TRUE(std::ranges::is_sorted(mine));
      for (const std::string& label : mine) ++times[label];
      std::ranges::shuffle(labels, random);
      EXPECT_EQ(dealt(labels, {i, count}), mine);
    }
    EXPECT_EQ(times.size(), labels.size());
    for (const auto& [label, n] : times) EXPECT_EQ(n, 1U) << label;
  }
}

TEST(Shard, NoneHasMoreToDoThanAnotherByMoreThanTheLargestLabel) {
  std::mt19937 random(2);
  for (int round = 0; round < 200; ++round) {
    std::map<std::string, std::size_t> sizes;
    std::vector<LabelSize> labels = random_labels(random);
    std::size_t largest = 1;
    for (const auto& [label, size] : labels) {
      sizes[label] = std::max<std::size_t>(1, size);
      largest = std::max(largest, size);
    }
    std::vector<std::size_t> loads;
    for (std::size_t i = 0; i < 5; ++i) {
      loads.push_back(0);
      for (const std::string& label : dealt(labels, {i, 5})) loads.back() += sizes[label];
    }
    const auto [least, most] = std::ranges::minmax(loads);
    EXPECT_LE(most - least, largest);
  }
}

TEST(Shard, TogetherTheyWriteTheFilesOfOneJob) {
  constexpr int labels = 11;
  for (const std::uint32_t seed : {1U, 2U}) {
    const Folder folder;
    static_cast<void>(folder.write("in.ndjson", many_labels(labels, seed)));
    std::filesystem::create_directory(folder / "whole");
    ASSERT_EQ(run(folder, "reconstruct in.ndjson -q -o 'whole/{label}.ply'").exit_code, 0);
    const auto whole = files_in(folder / "whole");
    ASSERT_EQ(whole.size(), std::size_t{labels});
    for (const int count : {1, 2, 3, 7, labels + 4}) {
      const std::string parts = "parts" + std::to_string(count);
      std::filesystem::create_directory(folder / parts);
      int made = 0;
      for (int i = count - 1; i >= 0; --i) {  // any order
        const Outcome job =
            run(folder, "reconstruct in.ndjson -q --json -o '" + parts + "/{label}.ply' --shard " +
                            std::to_string(i) + '/' + std::to_string(count));
        ASSERT_EQ(job.exit_code, 0) << job.err;
        made += static_cast<int>(nlohmann::json::parse(job.out)["parts"].size());
      }
      EXPECT_EQ(made, labels) << count << " shards";
      EXPECT_EQ(files_in(folder / parts), whole) << count << " shards";
    }
  }
}

TEST(Shard, OfSeveralFilesIsOfTheirLabelsTogether) {
  const Folder folder;
  std::string inputs;
  for (const std::string name : {"a", "b", "c"}) {
    static_cast<void>(folder.write(name + ".ndjson", barrel()));
    inputs += name + ".ndjson ";
  }
  for (const std::string i : {"0", "1"})
    EXPECT_EQ(
        run(folder, "reconstruct " + inputs + "-q -o '{label}.off' --shard " + i + "/2").exit_code,
        0);
  for (const std::string name : {"a", "b", "c"})
    EXPECT_FALSE(content(folder / (name + ".off")).empty());
}

TEST(Shard, WithoutALabelSucceedsAndWritesNothing) {
  const Folder folder;
  static_cast<void>(folder.write("in.ndjson", barrel()));
  const Outcome made = run(folder, "reconstruct in.ndjson -o '{label}.ply' --json --shard 1/2");
  EXPECT_EQ(made.exit_code, 0) << made.err;
  EXPECT_NE(made.err.find("nothing to do"), std::string::npos) << made.err;
  EXPECT_TRUE(nlohmann::json::parse(made.out)["parts"].empty());
  for (const auto& [name, bytes] : files_in(folder / ".")) EXPECT_FALSE(name.ends_with(".ply"));
}

// The second job replaced the file of the first; tables of volumes, too.
TEST(Shard, OfAFileOfAllLabelsIsRefused) {
  const Folder folder;
  static_cast<void>(folder.write("in.ndjson", many_labels(4, 3)));
  for (const std::string how :
       {"-o all.ply --shard 0/2", "-o '{label}.ply' -o all.glb --shard 0/2",
        "-o '{label}.ply' --csv v.csv --shard 0/2", "-o all.ply --csv v.csv --skip-existing"}) {
    const Outcome refused = run(folder, "reconstruct in.ndjson " + how);
    EXPECT_EQ(refused.exit_code, 2) << how;
    EXPECT_NE(refused.err.find("would replace"), std::string::npos) << refused.err;
  }
  for (const auto& [name, bytes] : files_in(folder / "."))
    EXPECT_TRUE(name == "in.ndjson" || name.ends_with(".txt")) << name;
}

TEST(Shard, OfContoursWithoutLabelBesideOthersIsThatOfThose) {
  const Folder folder;
  const auto both = [](double z) {
    std::string line = slice(z, ring(2) + ", " + ring(1, 8, 9));
    line.insert(line.find_last_of('}'), R"(, "labels": ["", "h"])");
    return line;
  };
  static_cast<void>(folder.write("in.ndjson", both(0) + both(1)));
  EXPECT_EQ(run(folder, "reconstruct in.ndjson --merge -q --only '' -o a.ply").exit_code, 0);
}

TEST(Shard, WhereAllLabelsAreSkippedIsNoFailureOfTheOthers) {
  const Folder folder;
  std::string line = slice(0, ring(2) + ", " + ring(1, 8, 9));
  line.insert(line.find_last_of('}'), R"(, "labels": ["body", "seed"])");
  std::string next = slice(1, ring(2));
  next.insert(next.find_last_of('}'), R"(, "labels": ["body"])");
  static_cast<void>(folder.write("in.ndjson", line + next));
  for (const std::string i : {"0", "1"})
    EXPECT_EQ(run(folder, "reconstruct in.ndjson -o '{label}.ply' --shard " + i + "/2").exit_code,
              0);
  EXPECT_TRUE(std::filesystem::exists(folder / "body.ply"));
}

TEST(Shard, ReportsTimeAndMemoryOfEachLabelAndOfTheJob) {
  const Folder folder;
  static_cast<void>(folder.write("in.ndjson", many_labels(4, 3)));
  for (const std::string how : {"-o '{label}.ply'", "-o out.ply", "-o out.ply --out-of-core"}) {
    const auto report =
        nlohmann::json::parse(run(folder, "reconstruct in.ndjson -q --json " + how).out);
    EXPECT_TRUE(report["shard"].is_null());
    const double most = report["peak_memory_mb"];
    EXPECT_GT(most, 1) << how;
    EXPECT_LT(most, 200) << how;
    for (const auto& part : report["parts"]) {
      EXPECT_GE(part["seconds"]["total"].get<double>(), 0);
      EXPECT_GT(part["peak_memory_mb"].get<double>(), 1);
      EXPECT_LE(part["peak_memory_mb"].get<double>(), most);
    }
  }
}

}  // namespace
}  // namespace loft::app
