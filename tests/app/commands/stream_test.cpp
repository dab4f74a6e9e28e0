// SPDX-License-Identifier: MIT
// `loft stream` as its users have it: pipes, files that grow, outputs, replays.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "io/meshes.h"
#include "tests/app/running.h"
#include "tests/app/streaming.h"

namespace loft::app {
namespace {

using namespace testing;
using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(Stream, EditsFromAPipeMakeTheSurfaceOfWhatIsLeft) {
  const Folder folder;
  std::ofstream(folder / "stdin") << leaning(3) << leaning(0) << "{\"op\": \"remove\", \"z\": 0}\n"
                                  << leaning(1) << "\n"
                                  << leaning(9) << leaning(2)
                                  << R"({"op": "replace", "z": 9, "contours": [)" << ring(3)
                                  << "]}";
  const Outcome outcome = run(folder, "stream -o out.ply --json");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(json::parse(outcome.out)["edits"], 7);
  expect_surface_of(folder, leaning(1) + leaning(2) + leaning(3) + slice(9, ring(3)), "out.ply");
}

TEST(Stream, TheFirstLineOfAFileSaysUnitAndFill) {
  const Folder folder;
  const std::string about = R"({"stack": {"unit": "um", "fill": "nonzero"}})"
                            "\n";
  static_cast<void>(folder.write("in.ndjson", about + stack(3)));
  const Outcome outcome = run(folder, "stream in.ndjson -o out.gltf --strict --json");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(json::parse(outcome.out)["edits"], 3);
  ASSERT_EQ(run(folder, "reconstruct in.ndjson -o batch.gltf").exit_code, 0);
  const auto extras = [&](const char* file) {
    return json::parse(content(folder / file))["asset"]["extras"];
  };
  EXPECT_EQ(extras("out.gltf")["metres_per_unit"], 1e-6);
  EXPECT_EQ(extras("out.gltf")["metres_per_unit"], extras("batch.gltf")["metres_per_unit"]);
  EXPECT_EQ(extras("out.gltf")["settings"]["fill"], "nonzero");
  ASSERT_EQ(run(folder, "stream in.ndjson -o given.gltf --unit cm --fill evenodd").exit_code, 0);
  EXPECT_EQ(extras("given.gltf")["metres_per_unit"], 0.01);
  EXPECT_EQ(extras("given.gltf")["settings"]["fill"], "evenodd");
}

/// The colour of the first material of a GLB.
std::vector<int> colour_in(const std::filesystem::path& glb) {
  const auto colour = io::read_meshes(glb)[0].colour.value_or(Colour());
  return {colour.red, colour.green, colour.blue};
}

TEST(Stream, HasTheColoursThatTheFirstLineSays) {
  const Folder folder;
  const std::string about =
      R"({"stack": {"labels": [{"name": "heart", "colour": "#d02030", "kind": "ORGAN"}]}})"
      "\n";
  std::string lines;
  for (int z = 0; z < 3; ++z)
    lines += R"({"z": )" + std::to_string(z) +
             R"(, "contours": [[[0, 0], [3, 0], [0, 3]]], "labels": ["heart"]})"
             "\n";
  static_cast<void>(folder.write("in.ndjson", about + lines));
  ASSERT_EQ(run(folder, "stream in.ndjson -o out.glb -o out.ply --replay film.glb --session kept")
                .exit_code,
            0);
  const std::vector<int> red{0xd0, 0x20, 0x30};
  EXPECT_EQ(colour_in(folder / "out.glb"), red);
  EXPECT_EQ(colour_in(folder / "out.ply"), red);
  EXPECT_EQ(colour_in(folder / "film.glb"), red);
  EXPECT_EQ(content(folder / "out.glb").find("\"settings\":{\"labels"), std::string::npos);

  ASSERT_EQ(run(folder, "stream --no-input --session kept -o resumed.glb").exit_code, 0);
  EXPECT_EQ(colour_in(folder / "resumed.glb"), red) << "the session remembers";
  for (const char* file : {"kept", "out.glb", "out.ply"}) {
    Running running(folder, {"view", file, "--port", "0"});
    const json labels = json::parse(running.client()->Get("/labels")->body)["labels"];
    EXPECT_EQ(labels[0]["colour"], "#d02030") << file;
    std::ofstream(folder / "slab.glb", std::ios::binary)
        << running.client()->Get("/slabs?ids=0-0..9")->body;
    EXPECT_EQ(colour_in(folder / "slab.glb"), red) << file;
  }
}

TEST(Stream, WhatItCannotTakeFromSuchALineIsSaid) {
  const Folder folder;
  std::ofstream(folder / "stdin") << R"({"stack": {"unit": "um"}})" << '\n' << stack(2);
  const Outcome piped = run(folder, "stream -o out.ply --strict");
  EXPECT_EQ(piped.exit_code, 0);
  EXPECT_THAT(piped.err, HasSubstr("standard input:1: unit and fill rule are taken from the first "
                                   "line of a file only; give --unit and --fill"));
  static_cast<void>(folder.write(
      "in.ndjson", R"({"stack": {"unit": "um", "frame": [1,0,0,5, 0,1,0,0, 0,0,1,0, 0,0,0,1]}})"
                   "\n" +
                       stack(2)));
  EXPECT_THAT(run(folder, "stream in.ndjson").err, HasSubstr("in.ndjson:1: a stream has no frame"));
  static_cast<void>(folder.write("bad.ndjson", R"({"stack": {"unti": "um"}})"
                                               "\n" +
                                                   stack(2)));
  const Outcome bad = run(folder, "stream bad.ndjson --strict");
  EXPECT_EQ(bad.exit_code, 3);
  EXPECT_THAT(bad.err, AllOf(HasSubstr("bad.ndjson:1: "), HasSubstr("unti")));
}

TEST(Stream, BadLinesAreNamedAndLeftOut) {
  const Folder folder;
  std::ofstream(folder / "stdin") << leaning(0) << "{\"z\": 1, \"contours\": [[[0, NaN]]]}\n"
                                  << "{\"op\": \"replace\", \"z\": 7, \"contours\": []}\nnonsense\n"
                                  << leaning(1);
  const Outcome outcome = run(folder, "stream -o out.ply");
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.err,
              AllOf(HasSubstr("standard input:2: contour 0 point 0: NaN"),
                    HasSubstr("standard input:3: there is no slice at z = 7; the nearest is at "
                              "z = 0"),
                    HasSubstr("standard input:4: "), HasSubstr("3 rejected")));
  expect_surface_of(folder, stack(2), "out.ply");
  EXPECT_EQ(run(folder, "stream --strict").exit_code, 3);
}

TEST(Stream, EachLineOfAComplaintSaysWhere) {
  const Folder folder;
  std::ofstream(folder / "stdin") << leaning(0)
                                  << R"({"z": 1, "contours": [[[0, 0], [1e200, 0], [0, 1e200]]]})"
                                  << '\n';
  const std::string words = run(folder, "stream").err;
  EXPECT_THAT(words, HasSubstr("standard input:2: slice 1 (z = 1) contour 0 point 1"));
  EXPECT_THAT(words, HasSubstr("standard input:2: slice 1 (z = 1) contour 0 point 2"));
}

TEST(Stream, AnEndlessLineIsLeftOut) {
  const Folder folder;
  std::ofstream(folder / "stdin") << leaning(0) << std::string(std::size_t{257} << 20U, ' ') << '\n'
                                  << leaning(1);
  const Outcome outcome = run(folder, "stream -o out.ply");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("standard input:2: the line is longer than 256 MiB"));
  expect_surface_of(folder, stack(2), "out.ply");
}

TEST(Stream, LabelsAreSurfacesOfTheirOwn) {
  const Folder folder;
  const auto line = [](int z, bool has_bone) {
    return R"({"z": )" + std::to_string(z) + R"(, "contours": [)" + ring(9) +
           (has_bone ? ", " + ring(2) : "") + R"(], "labels": ["skin")" +
           (has_bone ? R"(, "bone")" : "") + "]}\n";
  };
  std::string lines;
  for (int z = 0; z < 5; ++z) lines += line(z, z > 1);
  std::ofstream(folder / "stdin") << lines;
  EXPECT_EQ(run(folder, "stream -o out.ply").exit_code, 0);
  expect_surface_of(folder, lines, "out.ply");
}

TEST(Stream, FollowsAFileWhileItGrows) {
  const Folder folder;
  std::ofstream file(folder / "in.ndjson");
  file << leaning(0) << std::flush;
  Running running(folder, {"stream", "in.ndjson", "--follow", "-o", "out.ply", "--port", "0"});
  const auto client = running.client();
  const auto slices = [&] {
    const auto answer = client->Get("/status");
    return answer ? json::parse(answer->body)["slices"].get<int>() : -1;
  };
  const auto wait_for = [&](int count) {
    for (int i = 0; i < 1000 && slices() != count; ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    return slices();
  };
  EXPECT_EQ(wait_for(1), 1);
  const std::string next = leaning(1);
  file << next.substr(0, 20) << std::flush;  // the rest of the line is still to come
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  EXPECT_EQ(slices(), 1);
  file << next.substr(20) << leaning(2) << std::flush;
  EXPECT_EQ(wait_for(3), 3);
  EXPECT_EQ(running.interrupt(), 0);
  expect_surface_of(folder, stack(3), "out.ply");
}

/// Follows a file of edits; has written out.ply when it has taken in a stack of three.
class Following : public ::testing::Test {
 protected:
  Folder folder_;
  std::ofstream file_{folder_ / "in.ndjson"};
  std::optional<Running> running_;

  void start(const std::vector<std::string>& more = {}) {
    file_ << stack(3) << std::flush;
    std::vector<std::string> words{"stream",  "in.ndjson", "--follow", "-o",
                                   "out.ply", "--every",   "3"};
    words.insert(words.end(), more.begin(), more.end());
    running_.emplace(folder_, words);
    for (int i = 0; i < 3000 && !std::filesystem::exists(folder_ / "out.ply"); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    ASSERT_TRUE(std::filesystem::exists(folder_ / "out.ply"));
    std::filesystem::remove(folder_ / "out.ply");
  }
};

TEST_F(Following, ALostTerminalIsARequestToEnd) {
  std::signal(SIGHUP, SIG_DFL);  // the tests themselves may be run by nohup
  std::signal(SIGPIPE, SIG_DFL);
  start();
  running_->send(SIGPIPE);
  running_->send(SIGHUP);
  EXPECT_EQ(running_->wait(), 0);
  expect_surface_of(folder_, stack(3), "out.ply");
}

TEST_F(Following, WhatCannotBeReadAnyMoreEndsTheInputOnly) {
  start();
  std::filesystem::remove(folder_ / "in.ndjson");
  std::filesystem::create_directory(folder_ / "in.ndjson");
  EXPECT_EQ(running_->wait(), 3);
  EXPECT_THAT(content(folder_ / "err.txt"), HasSubstr("cannot read in.ndjson: it is a folder"));
  expect_surface_of(folder_, stack(3), "out.ply");
}

TEST_F(Following, ALineWithoutItsEndIsNoEditYet) {
  start({"--session", "c.session"});
  file_ << leaning(3).substr(0, 10) << std::flush;
  ASSERT_EQ(running_->interrupt(), 0);
  EXPECT_THAT(content(folder_ / "err.txt"),
              HasSubstr("in.ndjson: the last 10 bytes were left out"));
  expect_surface_of(folder_, stack(3), "out.ply");
  file_ << leaning(3).substr(10) << std::flush;
  ASSERT_EQ(run(folder_, "stream in.ndjson --session c.session -o out.ply").exit_code, 0);
  expect_surface_of(folder_, stack(4), "out.ply");
}

TEST(Stream, WritesItsOutputsOnRequestAndEverySoOften) {
  const Folder folder;
  Running running(folder, {"stream", "--no-input", "--port", "0", "-o", "out.ply", "--every", "5"});
  const auto client = running.client();
  ASSERT_TRUE(client->Post("/slices", stack(3), "application/x-ndjson"));
  EXPECT_FALSE(std::filesystem::exists(folder / "out.ply"));
  const auto wait_for_output = [&] {
    for (int i = 0; i < 1000 && !std::filesystem::exists(folder / "out.ply"); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    return std::filesystem::exists(folder / "out.ply");
  };
  running.send(SIGUSR1);
  ASSERT_TRUE(wait_for_output());
  expect_surface_of(folder, stack(3), "out.ply");
  std::filesystem::remove(folder / "out.ply");
  ASSERT_TRUE(client->Post("/slices", leaning(3) + leaning(4), "application/x-ndjson"));
  ASSERT_TRUE(wait_for_output());
  expect_surface_of(folder, stack(5), "out.ply");
}

TEST(Stream, OptionsThatMakeNoSenseAreRefused) {
  const Folder folder;
  std::ofstream(folder / "in.ndjson") << stack(3);
  const std::vector<std::pair<std::string, std::string>> cases{
      {"in.ndjson --no-input --port 0", "exclude each other"},
      {"--no-input -o a.ply", "nothing to do"},
      {"--follow", "needs a file"},
      {"- --follow", "needs a file"},
      {"in.ndjson --host ::1", "needs --port or --view"},
      {"in.ndjson --every -1", "--every"},
      {"in.ndjson -o same.glb --replay same.glb", "two names"},
      {"in.ndjson -o ./same.ply --session same.ply", "will not be overwritten"},
  };
  for (const auto& [words, expected] : cases) {
    const Outcome outcome = run(folder, "stream " + words);
    EXPECT_EQ(outcome.exit_code, 2) << words;
    EXPECT_THAT(outcome.err, HasSubstr(expected)) << words;
  }
}

TEST(Stream, AnOutputThatCannotBeWrittenLeavesTheOthers) {
  const Folder folder;
  std::filesystem::create_directory(folder / "gone");
  Running running(folder, {"stream", "--no-input", "--port", "0", "-o", "gone/a.ply", "-o", "b.ply",
                           "--replay", "c.glb", "--json"});
  ASSERT_TRUE(running.client()->Post("/slices", stack(3), "application/x-ndjson"));
  std::filesystem::remove_all(folder / "gone");
  EXPECT_EQ(running.interrupt(), 4);
  EXPECT_THAT(content(folder / "err.txt"), HasSubstr("gone/a.ply"));
  EXPECT_THAT(content(folder / "out.txt"), HasSubstr("loft-stream"));
  EXPECT_TRUE(std::filesystem::exists(folder / "c.glb"));
  expect_surface_of(folder, stack(3), "b.ply");
}

TEST(Stream, AReplayShowsASessionAsItWasCaptured) {
  const Folder folder;
  std::ofstream(folder / "stdin") << stack(5) << "{\"op\": \"remove\", \"z\": 2}\n";
  ASSERT_EQ(run(folder, "stream --session c.session --replay first.glb").exit_code, 0);
  std::ofstream(folder / "stdin") << "";
  ASSERT_EQ(run(folder, "stream --session c.session --replay again.glb").exit_code, 0);
  EXPECT_EQ(content(folder / "first.glb"), content(folder / "again.glb"));
  EXPECT_THAT(content(folder / "again.glb"), HasSubstr("\"STEP\""));
  for (const std::string rate : {"0", "1e-9", "1e9", "nan", "fast"}) {
    const Outcome outcome = run(folder, "stream --replay r.glb --replay-rate " + rate);
    EXPECT_EQ(outcome.exit_code, 2) << rate;
    EXPECT_THAT(outcome.err, HasSubstr("is no rate"));
  }
  EXPECT_EQ(run(folder, "stream --replay r.ply").exit_code, 2);
}

TEST(Stream, AReplayThatFailsDoesNotStopTheCapture) {
  const Folder folder;
  std::ofstream edits(folder / "stdin");
  for (const char* z : {"0", "1e38", "2e38"})
    edits << R"({"z": )" << z << R"(, "contours": [[[0,0],[1e39,0],[1e39,1e39],[0,1e39]]]})"
          << '\n';
  edits.close();
  const Outcome outcome =
      run(folder, "stream --unit m --session c.session -o out.ply --replay replay.glb");
  EXPECT_EQ(outcome.exit_code, 4) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("too large for glTF"));
  EXPECT_THAT(run(folder, "session list c.session").out, HasSubstr("3 edits, 3 slices now"));
  EXPECT_TRUE(std::filesystem::exists(folder / "out.ply"));
  EXPECT_FALSE(std::filesystem::exists(folder / "replay.glb"));
}

}  // namespace
}  // namespace loft::app
