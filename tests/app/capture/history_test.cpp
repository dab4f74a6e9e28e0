// SPDX-License-Identifier: MIT
// Undo and redo: whatever was edited and taken back, the surface is that of what remains.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "tests/app/streaming.h"

namespace loft::app {
namespace {

using namespace testing;
using ::testing::HasSubstr;

/// What a stack with its way back and forth should be: states, one after the other.
class Expected {
 public:
  using State = std::map<int, std::string>;  // contours by height

  void edit(const State& state) {
    states_.resize(now_ + 1);
    states_.push_back(state);
    ++now_;
  }
  [[nodiscard]] bool can(bool is_redo) const {
    return is_redo ? now_ + 1 < states_.size() : now_ > 0;
  }
  void go(bool is_redo) { is_redo ? ++now_ : --now_; }
  [[nodiscard]] const State& state() const { return states_[now_]; }
  [[nodiscard]] std::string stack() const {
    std::string lines;
    for (const auto& [z, contours] : state()) lines += slice(z, contours);
    return lines;
  }

 private:
  std::vector<State> states_{{}};
  std::size_t now_ = 0;
};

class RandomWay {
 public:
  RandomWay(unsigned seed, httplib::Client& client, Expected& expected)
      : random_(seed), client_(client), expected_(expected) {}

  void step() {
    const auto choice = random_() % 10;
    if (choice < 3) return go(false);
    if (choice < 5) return go(true);
    Expected::State state = expected_.state();
    const int z = static_cast<int>(random_() % 7);
    const bool is_there = state.contains(z);
    const std::string contours =
        ring(3 + static_cast<double>(random_() % 100) / 50, 7 + static_cast<int>(random_() % 5));
    if (is_there && choice == 5) {
      state.erase(z);
      post(R"({"op":"remove","z":)" + std::to_string(z) + "}");
    } else {
      state[z] = is_there && choice == 6 ? state[z] + ", " + contours : contours;
      const std::string line = slice(z, contours);
      post(is_there && choice != 6 ? R"({"op":"replace",)" + line.substr(1) : line);
    }
    expected_.edit(state);
  }

 private:
  void post(const std::string& line) {
    const auto answer = client_.Post("/slices", line, "application/x-ndjson");
    ASSERT_EQ(answer->status, 200) << answer->body;
  }
  void go(bool is_redo) {
    const auto answer = client_.Post(is_redo ? "/redo" : "/undo", "", "text/plain");
    EXPECT_EQ(answer->status, expected_.can(is_redo) ? 200 : 409) << answer->body;
    if (expected_.can(is_redo)) expected_.go(is_redo);
  }

  std::mt19937 random_;
  httplib::Client& client_;
  Expected& expected_;
};

void expect_surface(const Folder& folder, httplib::Client& client, const Expected& expected) {
  const json heights = json::parse(client.Get("/slices")->body)["slices"];
  EXPECT_EQ(heights.size(), expected.state().size());
  const auto surface = client.Get("/surface.ply");
  if (expected.state().size() < 2) return;
  ASSERT_EQ(surface->status, 200);
  std::ofstream(folder / "live.ply", std::ios::binary) << surface->body;
  expect_surface_of(folder, expected.stack(), "live.ply");
}

TEST(History, UndoingAndRedoingLeavesWhatRemains) {
  for (const bool has_session : {false, true}) {
    const Folder folder;
    std::vector<std::string> words{"stream", "--no-input", "--port", "0"};
    if (has_session) words.insert(words.end(), {"--session", "kept"});
    Running running(folder, words);
    const auto client = running.client();
    Expected expected;
    RandomWay way(has_session ? 1 : 2, *client, expected);
    for (int i = 0; i < 60; ++i) {
      way.step();
      if (i % 20 == 19) expect_surface(folder, *client, expected);
    }
    EXPECT_EQ(running.interrupt(), 0);
  }
}

TEST(History, GoesOnWhereAKilledCaptureWas) {
  const Folder folder;
  Expected expected;
  for (unsigned seed = 10; seed < 14; ++seed) {
    Running running(folder, {"stream", "--no-input", "--port", "0", "--session", "kept"});
    const auto client = running.client();
    expect_surface(folder, *client, expected);
    RandomWay way(seed, *client, expected);
    for (int i = 0; i < 15; ++i) way.step();
    running.kill();
  }
  EXPECT_EQ(run(folder, "session verify kept").exit_code, 0);
}

TEST(History, IsToldWithWhatWasUndone) {
  const Folder folder;
  Running running(folder, {"stream", "--no-input", "--port", "0"});
  const auto client = running.client();
  EXPECT_EQ(client->Post("/undo", "", "text/plain")->status, 409);
  ASSERT_EQ(client->Post("/slices", stack(3), "text/plain")->status, 200);
  const auto undone = client->Post("/undo", "", "text/plain");
  ASSERT_EQ(undone->status, 200);
  const json result = json::parse(undone->body)["results"][0];
  EXPECT_EQ(result["op"], "remove");
  EXPECT_EQ(result["z"], 2.0);
  EXPECT_EQ(result["removed"].size(), 2U);
  const json history = json::parse(client->Get("/history")->body);
  ASSERT_EQ(history["edits"].size(), 4U);
  EXPECT_EQ(history["edits"][2]["number"], 3);
  EXPECT_EQ(history["edits"][2]["is_undone"], true);
  EXPECT_EQ(history["edits"][3]["op"], "undo");
  EXPECT_EQ(history["can_undo"], true);
  EXPECT_EQ(history["can_redo"], true);
  ASSERT_EQ(client->Post("/slices", leaning(7), "text/plain")->status, 200);
  EXPECT_EQ(client->Post("/redo", "", "text/plain")->status, 409);
  EXPECT_EQ(client->Get("/undo")->status, 405);
}

TEST(History, OfASessionCanBeUndoneAndLookedAt) {
  const Folder folder;
  std::ofstream(folder / "stdin") << stack(4);
  ASSERT_EQ(run(folder, "stream --session kept").exit_code, 0);
  std::filesystem::remove(folder / "stdin");
  const Outcome undone = run(folder, "session undo kept");
  EXPECT_EQ(undone.exit_code, 0);
  EXPECT_THAT(undone.err, HasSubstr("undo of edit 4: remove z = 3"));
  EXPECT_THAT(run(folder, "session history kept").out,
              HasSubstr("4 insert z = 3, undone\n5 undo z = 3\n"));
  const json history = json::parse(run(folder, "session history kept --json").out);
  EXPECT_EQ(history["edits"].size(), 5U);

  ASSERT_EQ(run(folder, "session export kept --at 4 -o four.ndjson").exit_code, 0);
  ASSERT_EQ(run(folder, "session export kept -o now.ndjson").exit_code, 0);
  const auto lines = [&](const char* file) {
    const std::string text = content(folder / file);
    return std::ranges::count(text, '\n');
  };
  EXPECT_EQ(lines("four.ndjson"), 4);
  EXPECT_EQ(lines("now.ndjson"), 3);
  for (const char* words : {"session export kept --at 6", "view kept --at 6 --port 0"}) {
    const Outcome outcome = run(folder, words);
    EXPECT_EQ(outcome.exit_code, 3) << words;
    EXPECT_THAT(outcome.err, HasSubstr("it has 5 edits, and not 6"));
  }
  Running running(folder, {"view", "kept", "--at", "2", "--port", "0"});
  const auto client = running.client();
  EXPECT_EQ(reset_event(*client)["slices"], json::array({0.0, 1.0}));
  EXPECT_EQ(client->Post("/undo", "", "text/plain")->status, 404);
  EXPECT_EQ(json::parse(client->Get("/history")->body)["can_undo"], false);

  EXPECT_EQ(run(folder, "session redo kept").exit_code, 0);
  EXPECT_EQ(run(folder, "session redo kept").exit_code, 1);
}

}  // namespace
}  // namespace loft::app
