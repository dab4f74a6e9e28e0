// SPDX-License-Identifier: MIT
// Jobs that are killed and started again.
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "tests/app/many_labels.h"
#include "tests/app/running.h"

namespace loft::app {
namespace {

using namespace testing;

const std::vector<std::string> resumable{"reconstruct", "in.ndjson",       "-q",
                                         "-o",          "out/{label}.ply", "--skip-existing"};

/// Files that a job is still writing; they are not there yet.
bool is_temporary(const std::string& name) { return name.ends_with(".part"); }

TEST(SkipExisting, AfterKillsNothingIsLostAndBytesAreTheSame) {
  const Folder folder;
  static_cast<void>(folder.write("in.ndjson", many_labels(40, 7, 12, 400)));
  for (const char* name : {"whole", "out"}) std::filesystem::create_directory(folder / name);
  ASSERT_EQ(run(folder, "reconstruct in.ndjson -q -o 'whole/{label}.ply'").exit_code, 0);
  const auto whole = files_in(folder / "whole");
  int kills = 0;
  for (int delay = 20; delay < 2000; delay += delay / 2) {
    Running job(folder, resumable);
    std::this_thread::sleep_for(std::chrono::milliseconds(delay));
    job.send(kills % 2 == 0 ? SIGKILL : SIGTERM);
    const int code = job.wait();
    for (const auto& [name, bytes] : files_in(folder / "out")) {
      if (is_temporary(name)) continue;
      EXPECT_EQ(bytes, whole.at(name)) << name << ": whole or not there";
    }
    if (code == 0) break;
    if (kills % 2 == 0) {
      EXPECT_EQ(code, -SIGKILL);
    } else {
      EXPECT_TRUE(code == 130 || code == -SIGTERM) << code;  // it had not begun
    }
    ++kills;
  }
  EXPECT_GT(kills, 0);
  EXPECT_EQ(Running(folder, resumable).wait(), 0);
  auto made = files_in(folder / "out");
  std::erase_if(made, [](const auto& file) { return is_temporary(file.first); });
  EXPECT_EQ(made, whole);
}

TEST(SkipExisting, WorksOnNothingThatIsThereAndSaysSo) {
  const Folder folder;
  static_cast<void>(folder.write("in.ndjson", many_labels(3, 1)));
  static_cast<void>(folder.write("cell 1.ply", "as it is"));
  const auto job = [&folder] {
    return nlohmann::json::parse(
        run(folder, "reconstruct in.ndjson --json -o '{label}.ply' --skip-existing").out);
  };
  const auto first = job();
  EXPECT_EQ(first["parts"].size(), 2U);
  EXPECT_EQ(first["existing"], nlohmann::json::array({"cell 1"}));
  EXPECT_EQ(content(folder / "cell 1.ply"), "as it is");
  EXPECT_EQ(job()["existing"].size(), 3U);
}

TEST(SkipExisting, MakesALabelThatLacksOneOfItsFilesAndKeepsTheOther) {
  const Folder folder;
  static_cast<void>(folder.write("in.ndjson", many_labels(2, 1)));
  static_cast<void>(folder.write("cell 1.ply", "as it is"));
  const std::string outputs = "-o '{label}.ply' -o '{label}.off' -o all.glb --skip-existing";
  EXPECT_EQ(run(folder, "reconstruct in.ndjson -q " + outputs).exit_code, 0);
  EXPECT_EQ(content(folder / "cell 1.ply"), "as it is");
  for (const char* name : {"cell 0.ply", "cell 0.off", "cell 1.off", "all.glb"})
    EXPECT_FALSE(content(folder / name).empty()) << name;
}

TEST(SkipExisting, ReadsNothingWhereAllIsKnownToBeThere) {
  const Folder folder;
  static_cast<void>(folder.write("none.ndjson", "no stack"));  // reading it would fail
  static_cast<void>(folder.write("out.ply", "as it is"));
  static_cast<void>(folder.write("a.ply", "as it is"));
  EXPECT_EQ(run(folder, "reconstruct none.ndjson -o out.ply --skip-existing").exit_code, 0);
  EXPECT_EQ(
      run(folder, "reconstruct none.ndjson -o '{label}.ply' --only a --skip-existing").exit_code,
      0);
  EXPECT_EQ(
      run(folder, "reconstruct none.ndjson -o '{label}.ply' --only 'a*' --skip-existing").exit_code,
      3);
  EXPECT_EQ(run(folder, "reconstruct missing.ndjson -o out.ply --skip-existing").exit_code, 3);
}

TEST(SkipExisting, AskedToEndSaysWhatIsDone) {
  const Folder folder;
  static_cast<void>(folder.write("in.ndjson", many_labels(200, 5, 12, 400)));
  std::filesystem::create_directory(folder / "out");
  Running job(folder, resumable);
  for (int i = 0; i < 3000 && std::filesystem::is_empty(folder / "out"); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  job.send(SIGTERM);
  EXPECT_EQ(job.wait(), 130);
  EXPECT_NE(content(folder / "err.txt").find("interrupted"), std::string::npos);
  for (const auto& [name, bytes] : files_in(folder / "out")) EXPECT_FALSE(is_temporary(name));
}

TEST(FilesOfLabels, NeedTheirFolder) {
  const Folder folder;
  static_cast<void>(folder.write("in.ndjson", many_labels(2, 1)));
  const Outcome made = run(folder, "reconstruct in.ndjson -o 'out/{label}.ply'");
  EXPECT_EQ(made.exit_code, 4);
  EXPECT_NE(made.err.find("folder out does not exist; create it first"), std::string::npos)
      << made.err;
}

}  // namespace
}  // namespace loft::app
