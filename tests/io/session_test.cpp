// SPDX-License-Identifier: MIT
#include "io/session.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <random>
#include <string>
#include <vector>

#include "io/file.h"

namespace loft::io {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

Edit edit(std::size_t number, std::size_t points = 3) {
  Edit edit{Edit::Kind::insert, {static_cast<double>(number) / 3, {{{}, "part"}}}};
  for (std::size_t i = 0; i < points; ++i)
    edit.slice.contours[0].points.push_back(
        {static_cast<double>(i) / 7, static_cast<double>(number) * 1e-9});
  return edit;
}

std::vector<Edit> all(const Session& session) {
  std::vector<Edit> edits;
  session.for_each([&](std::uint64_t number, Edit&& one) {
    EXPECT_EQ(number, edits.size());
    edits.push_back(std::move(one));
  });
  return edits;
}

class SessionFile : public testing::Test {
 protected:
  void SetUp() override {
    folder_ =
        std::filesystem::temp_directory_path() / ("loft_session_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
    path_ = folder_ / "capture.session";
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  [[nodiscard]] Session write() const { return {path_, Session::Access::write}; }
  [[nodiscard]] Session read() const { return {path_, Session::Access::read}; }

  std::filesystem::path folder_;
  std::filesystem::path path_;
};

TEST_F(SessionFile, KeepsEditsAndSettings) {
  const std::vector<Edit> edits{
      edit(0), {Edit::Kind::replace, edit(0, 5).slice}, edit(2), {Edit::Kind::remove, {0, {}}}};
  {
    Session session = write();
    session.append(std::span(edits).first(1));
    session.append(std::span(edits).subspan(1));
    session.set_settings({{"fill", "evenodd"}, {"cap", "flat"}});
    EXPECT_EQ(all(read()), edits);  // others may read meanwhile
  }
  Session again = write();
  EXPECT_EQ(again.edit_count(), 4U);
  EXPECT_EQ(all(again), edits);
  EXPECT_EQ(again.settings()["fill"], "evenodd");
  again.append(std::vector{edit(7)});
  EXPECT_EQ(all(read()).back(), edit(7));
  again.check();
}

TEST_F(SessionFile, HasOneWriter) {
  const Session first = write();
  EXPECT_THAT([&] { static_cast<void>(write()); },
              ThrowsMessage<FileError>(HasSubstr("another process is writing")));
}

TEST_F(SessionFile, SaysWhatIsWrongWithTheFile) {
  EXPECT_THAT([&] { static_cast<void>(read()); },
              ThrowsMessage<FileError>(HasSubstr("No such file")));
  EXPECT_THAT([&] { Session(folder_ / "no" / "x", Session::Access::write); },
              ThrowsMessage<FileError>(HasSubstr("No such file or directory")));
  std::ofstream(path_) << "{\"z\": 1, \"contours\": []}\n" << std::string(5000, ' ');
  EXPECT_THAT([&] { static_cast<void>(read()); },
              ThrowsMessage<FileError>(HasSubstr("no session file")));
  EXPECT_THAT([&] { static_cast<void>(write()); },
              ThrowsMessage<FileError>(HasSubstr("no session file")));
}

TEST_F(SessionFile, FullDiskKeepsNothingOfWhatFailedAndGoesOnLater) {
  Session session = write();
  session.append(std::vector{edit(0)});
  rlimit before{};
  ::getrlimit(RLIMIT_FSIZE, &before);
  const rlimit small{60'000, before.rlim_max};
  std::signal(SIGXFSZ, SIG_IGN);
  ::setrlimit(RLIMIT_FSIZE, &small);
  const std::vector<Edit> large{edit(1), edit(2, 20'000)};
  EXPECT_THROW(session.append(large), FileError);
  ::setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_EQ(all(session), std::vector{edit(0)});
  session.append(large);
  EXPECT_EQ(all(session), (std::vector<Edit>{edit(0), edit(1), edit(2, 20'000)}));
}

TEST_F(SessionFile, RemembersHowFarAFileWasTakenIn) {
  const InputPosition a{"/a", 100, 1};
  const InputPosition b{"/b", 7, ~std::uint64_t{0}};
  {
    Session session = write();
    EXPECT_FALSE(session.input_position("/a"));
    session.append(std::vector{edit(0)}, a);
    session.append({}, b);
    session.append(std::vector{edit(1)}, InputPosition{"/a", 200, 2});
    session.append(std::vector{edit(2)});
  }
  const Session session = write();
  EXPECT_EQ(session.input_position("/a"), (InputPosition{"/a", 200, 2}));
  EXPECT_EQ(session.input_position("/b"), b);
  EXPECT_EQ(session.edit_count(), 3U);
}

TEST_F(SessionFile, DamageIsFoundOrHarmless) {
  std::vector<Edit> edits;
  for (std::size_t i = 0; i < 40; ++i) edits.push_back(edit(i, 1 + i % 5));
  write().append(edits);
  std::string good = read_file(path_);
  const auto seed = std::random_device()();
  std::cout << "seed " << seed << '\n';
  std::mt19937 random(seed);
  std::size_t found = 0;
  for (int i = 0; i < 150; ++i) {
    std::string bad = good;
    bad[random() % bad.size()] ^= static_cast<char>(1 + random() % 255);
    std::ofstream(path_, std::ios::binary | std::ios::trunc) << bad;
    try {
      const Session session = read();
      EXPECT_EQ(all(session), edits);
    } catch (const FileError&) {
      ++found;
    }
  }
  EXPECT_GT(found, 0U);
}

/// Appends edits until it is killed; says of each that it is kept.
[[noreturn]] void capture(const std::filesystem::path& path, int acknowledge) {
  Session session(path, Session::Access::write);
  for (std::size_t i = session.edit_count();; ++i) {
    session.append(std::vector{edit(i, 50)});
    if (::write(acknowledge, &i, sizeof i) != sizeof i) std::_Exit(1);
  }
}

TEST_F(SessionFile, WhatWasAcknowledgedSurvivesAKill) {
  const char* const wanted = std::getenv("LOFT_SOAK_KILLS");
  const int kills = wanted == nullptr ? 20 : std::atoi(wanted);
  const auto seed = std::random_device()();
  std::cout << "seed " << seed << '\n';
  std::mt19937 random(seed);
  std::size_t acknowledged = 0;
  for (int i = 0; i < kills; ++i) {
    int ends[2];
    ASSERT_EQ(::pipe(ends), 0);
    const pid_t child = ::fork();
    if (child == 0) capture(path_, ends[1]);
    ::close(ends[1]);
    ::usleep(static_cast<useconds_t>(1000 + random() % 40'000));
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    for (std::size_t number = 0; ::read(ends[0], &number, sizeof number) == sizeof number;)
      acknowledged = number + 1;
    ::close(ends[0]);
    if (acknowledged == 0) continue;
    const auto kept = all(read());
    ASSERT_GE(kept.size(), acknowledged);
    for (std::size_t k = 0; k < kept.size(); ++k) ASSERT_EQ(kept[k], edit(k, 50));
  }
  EXPECT_GT(acknowledged, 0U);
}

}  // namespace
}  // namespace loft::io
