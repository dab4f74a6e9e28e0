// SPDX-License-Identifier: MIT
// `loft stream --session`: what was acknowledged is there, whatever happens.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fstream>
#include <iostream>
#include <optional>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "tests/app/streaming.h"

namespace loft::app {
namespace {

using namespace testing;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

TEST(Session, WhatWasAcknowledgedIsThereAfterAKill) {
  const int kills = count_from("LOFT_SOAK_KILLS", 5);
  const auto seed = std::random_device()();
  std::cout << "seed " << seed << '\n';
  std::mt19937 random(seed);
  const Folder folder;
  int acknowledged = 0;
  for (int i = 0; i < kills; ++i) {
    Running running(folder, {"stream", "--no-input", "--port", "0", "--session", "c.session"});
    const auto client = running.client();
    std::thread sender([&] {
      for (;;) {
        const auto answer = client->Post("/slices", leaning(acknowledged), "application/x-ndjson");
        if (!answer || answer->status != 200) break;
        ++acknowledged;
      }
    });
    std::this_thread::sleep_for(std::chrono::milliseconds(random() % 300));
    running.kill();
    sender.join();
    ASSERT_EQ(run(folder, "session verify c.session").exit_code, 0);
    const auto exported = run(folder, "session export c.session -o -").out;
    ASSERT_GE(std::ranges::count(exported, '\n'), acknowledged);
    // One may be in the session that was not acknowledged any more.
    acknowledged = static_cast<int>(std::ranges::count(exported, '\n'));
  }
  ASSERT_GT(acknowledged, 1);
  std::ofstream(folder / "stdin");
  ASSERT_EQ(run(folder, "stream --session c.session -o out.ply").exit_code, 0);
  expect_surface_of(folder, stack(acknowledged), "out.ply");
}

TEST(Session, ResumesWithItsSettings) {
  const Folder folder;
  std::ofstream(folder / "stdin") << stack(3);
  ASSERT_EQ(run(folder, "stream --session c.session --cap dome --unit um").exit_code, 0);
  std::ofstream(folder / "stdin") << leaning(3);
  ASSERT_EQ(run(folder, "stream --session c.session -o out.ply").exit_code, 0);
  std::ofstream(folder / "all.ndjson") << stack(4);
  ASSERT_EQ(run(folder, "reconstruct all.ndjson --cap dome -o all.ply").exit_code, 0);
  EXPECT_EQ(triangles(folder / "out.ply"), triangles(folder / "all.ply"));
  for (const std::string cap : {"open", "flat"}) {
    const Outcome other = run(folder, "stream --session c.session --cap " + cap);
    EXPECT_EQ(other.exit_code, 2);
    EXPECT_THAT(other.err, HasSubstr("was begun with cap dome, not " + cap));
  }
  EXPECT_EQ(run(folder, "stream --session c.session --max-shift 3").exit_code, 2);
  EXPECT_EQ(run(folder, "stream --session c.session --cap dome --unit um").exit_code, 0);
}

TEST(Session, AFileIsTakenInOnce) {
  const Folder folder;
  std::ofstream file(folder / "in.ndjson");
  const std::string remove = "{\"op\": \"remove\", \"z\": 9}\n";
  file << stack(3) << remove << std::flush;
  const std::string words = "stream in.ndjson --session c.session";
  EXPECT_THAT(run(folder, words).err, HasSubstr("3 edits, 1 rejected"));
  // A slice comes in between that an edit of the file, rejected before, would remove.
  std::ofstream(folder / "stdin") << leaning(9);
  ASSERT_EQ(run(folder, "stream --session c.session").exit_code, 0);
  EXPECT_THAT(run(folder, words).err,
              AllOf(HasSubstr("resumed at line 5 of in.ndjson"), HasSubstr("4 edits, 0 rejected")));
  file << leaning(4) << std::flush;
  EXPECT_THAT(run(folder, words).err, HasSubstr("5 edits, 0 rejected; 5 slices"));
  EXPECT_THAT(run(folder, "session list c.session").out, Not(HasSubstr("in.ndjson")));

  std::ofstream(folder / "in.ndjson") << leaning(5);
  EXPECT_THAT(run(folder, words).err,
              AllOf(HasSubstr("is not the file any more"), HasSubstr("6 slices")));
}

TEST(Session, SlabsAreAsOldAsTheLastEditsOfTheirSlices) {
  const Folder folder;
  const std::vector<std::string> words{"stream", "--no-input", "--port", "0", "--session", "c"};
  {
    Running running(folder, words);
    const std::string edits = stack(4) + "{\"op\": \"remove\", \"z\": 1}\n" +
                              "{\"op\": \"replace\"," + leaning(0).substr(1) + leaning(1);
    ASSERT_EQ(running.client()->Post("/slices", edits, "application/x-ndjson")->status, 200);
  }
  Running running(folder, words);
  const json event = reset_event(*running.client());
  EXPECT_EQ(event["edits"], 7);
  std::vector<int> ages;
  for (const json& slab : event["slabs"]) ages.push_back(slab["edit"]);
  EXPECT_THAT(ages, ::testing::ElementsAre(7, 7, 4));
}

TEST(Session, CommandsLookInside) {
  const Folder folder;
  std::ofstream(folder / "stdin") << stack(3) << "{\"op\": \"remove\", \"z\": 1}\n";
  ASSERT_EQ(run(folder, "stream --session c.session").exit_code, 0);
  EXPECT_THAT(run(folder, "session list c.session").out,
              AllOf(HasSubstr("3 remove z = 1"), HasSubstr("4 edits, 2 slices now"),
                    HasSubstr("fill = evenodd")));
  EXPECT_EQ(json::parse(run(folder, "session list c.session --json").out)["edits"].size(), 4U);
  ASSERT_EQ(run(folder, "session export c.session -o out.ndjson").exit_code, 0);
  EXPECT_EQ(std::ranges::count(content(folder / "out.ndjson"), '\n'), 2);
  EXPECT_THAT(run(folder, "session export c.session --edits").out, HasSubstr("\"op\":\"remove\""));
  EXPECT_EQ(run(folder, "session verify c.session").exit_code, 0);
  EXPECT_EQ(run(folder, "session verify nothing").exit_code, 3);
  std::fstream file(folder / "c.session");
  file.seekp(8192 - 40);
  file << "damaged";
  file.close();
  const Outcome outcome = run(folder, "session verify c.session");
  EXPECT_EQ(outcome.exit_code, 1) << outcome.out;
  EXPECT_THAT(outcome.err, HasSubstr("damaged"));
}

TEST(Session, WhatCannotBeKeptIsNotTaken) {
  const Folder folder;
  {
    std::ofstream(folder / "stdin") << stack(2);
    ASSERT_EQ(run(folder, "stream --session c.session").exit_code, 0);
  }
  // No file of this process may grow beyond that.
  rlimit before{};
  ::getrlimit(RLIMIT_FSIZE, &before);
  const rlimit small{100'000, before.rlim_max};
  std::signal(SIGXFSZ, SIG_IGN);
  ::setrlimit(RLIMIT_FSIZE, &small);
  Running running(folder, {"stream", "--no-input", "--port", "0", "--session", "c.session"});
  const auto client = running.client();
  ::setrlimit(RLIMIT_FSIZE, &before);
  const auto answer = client->Post("/slices", leaning(2) + leaning(3, 5000), "text/plain");
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->status, 507) << answer->body;
  EXPECT_THAT(answer->body, HasSubstr("cannot write"));
  const json status = json::parse(client->Get("/status")->body);
  const int kept = status["slices"];
  EXPECT_THAT(kept, ::testing::AnyOf(2, 3));  // the first line may have been a batch of its own
  std::ofstream(folder / "live.ply", std::ios::binary) << client->Get("/surface.ply")->body;
  expect_surface_of(folder, stack(kept), "live.ply");
  running.kill();
  const auto exported = run(folder, "session export c.session").out;
  EXPECT_EQ(std::ranges::count(exported, '\n'), kept);
}

/// While the session may not grow, edits of a file wait.
class Waiting : public ::testing::Test {
 protected:
  Folder folder_;
  rlimit before_{};
  std::optional<Running> running_;

  void start(const std::vector<std::string>& more) {
    std::ofstream(folder_ / "stdin") << stack(2);
    ASSERT_EQ(run(folder_, "stream --session c.session").exit_code, 0);
    std::ofstream(folder_ / "in.ndjson") << leaning(2, 5000) << leaning(3) << leaning(4);
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit small{100'000, before_.rlim_max};
    std::signal(SIGXFSZ, SIG_IGN);
    ::setrlimit(RLIMIT_FSIZE, &small);
    std::vector<std::string> words{"stream", "in.ndjson", "--session", "c.session"};
    words.insert(words.end(), more.begin(), more.end());
    running_.emplace(folder_, words);
    ::setrlimit(RLIMIT_FSIZE, &before_);
    ASSERT_TRUE(running_->says("in.ndjson:1: cannot write c.session"));
  }
};

TEST_F(Waiting, EditsThatCannotBeKeptAreTakenInTheirOrderLater) {
  start({"--port", "0"});
  const auto client = running_->client();
  const auto has_slices = [&](int count) {
    for (int i = 0; i < 1000; ++i) {
      if (json::parse(client->Get("/status")->body)["slices"] == count) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
  };
  EXPECT_EQ(client->Post("/slices", leaning(9, 5000), "text/plain")->status, 507);
  EXPECT_TRUE(has_slices(2));  // one is tried now and then, and taken out again
  ASSERT_EQ(::prlimit(running_->process(), RLIMIT_FSIZE, &before_, nullptr), 0);
  EXPECT_TRUE(has_slices(5));
  EXPECT_EQ(running_->interrupt(), 0);
  EXPECT_THAT(content(folder_ / "err.txt"), HasSubstr("5 edits, 1 rejected"));
  const std::string list = run(folder_, "session list c.session").out;
  EXPECT_THAT(list, HasSubstr("2 insert z = 2, 1 contours, 5000 points\n3 insert z = 3, "));
  EXPECT_THAT(list, HasSubstr("5 edits, 5 slices now"));
}

TEST_F(Waiting, EditsThatWereNotKeptAreSaidAtTheEnd) {
  start({});
  EXPECT_EQ(running_->interrupt(), 4);
  EXPECT_THAT(content(folder_ / "err.txt"), HasSubstr("3 edits were not kept"));
}

}  // namespace
}  // namespace loft::app
