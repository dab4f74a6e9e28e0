// SPDX-License-Identifier: MIT
#include "io/session/session.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "io/bytes/file.h"

namespace loft::io {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
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
  EXPECT_THAT(again.check(), IsEmpty());
}

TEST_F(SessionFile, IsAFileWhateverItsName) {
  EXPECT_THAT([] { Session("", Session::Access::write); },
              ThrowsMessage<FileError>(HasSubstr("has no name")));
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(folder_);
  for (const char* name : {":memory:", "file:a?mode=memory"}) {
    Session(name, Session::Access::write).append(std::vector{edit(3)});
    EXPECT_EQ(all(Session(name, Session::Access::read)), std::vector{edit(3)}) << name;
  }
  std::filesystem::current_path(before);
}

TEST_F(SessionFile, TakesNothingWhenItWasDeletedOrReplaced) {
  Session session = write();
  session.append(std::vector{edit(0)});
  const auto elsewhere = folder_ / "elsewhere";
  for (const auto& path : {path_, folder_ / "capture.session-wal"}) {
    std::filesystem::rename(path, elsewhere);
    EXPECT_THAT([&] { session.append(std::vector{edit(1)}); },
                ThrowsMessage<FileError>(HasSubstr("deleted or replaced")));
    std::filesystem::copy_file(elsewhere, path);
    EXPECT_THROW(session.append(std::vector{edit(1)}), FileError);
    std::filesystem::rename(elsewhere, path);
  }
  session.append(std::vector{edit(2)});
  EXPECT_EQ(all(read()), (std::vector{edit(0), edit(2)}));
}

/// Runs `action` in a process whose user permissions bind; its words, empty if it throws nothing.
template <class Action>
std::string failure_as_nobody(Action action) {
  int ends[2];
  if (::pipe(ends) != 0) return "no pipe";
  const pid_t child = ::fork();
  if (child == 0) {
    if (::geteuid() == 0 && ::setuid(65534) != 0) std::_Exit(1);
    try {
      action();
    } catch (const FileError& error) {
      const std::string_view words = error.what();
      if (::write(ends[1], words.data(), words.size()) < 0) std::_Exit(1);
    }
    std::_Exit(0);
  }
  ::close(ends[1]);
  char words[1000];
  const ssize_t size = ::read(ends[0], words, sizeof words);
  ::close(ends[0]);
  ::waitpid(child, nullptr, 0);
  return {words, static_cast<std::size_t>(std::max<ssize_t>(size, 0))};
}

TEST_F(SessionFile, CanBeReadByWhoMayNotWrite) {
  using std::filesystem::perms;
  const auto inner = folder_ / "50% of #1?";
  path_ = inner / "capture.session";
  std::filesystem::create_directories(inner);
  const std::vector<Edit> edits{edit(0), edit(1)};
  write().append(edits);
  std::filesystem::permissions(
      inner, perms::all & ~(perms::owner_write | perms::group_write | perms::others_write));
  const auto read_all = [&] {
    if (all(read()) != edits) throw FileError(loft::io::Access::read, path_, "other edits");
  };
  EXPECT_EQ(failure_as_nobody(read_all), "");
  std::filesystem::permissions(path_, perms::all);
  EXPECT_THAT(failure_as_nobody([&] { static_cast<void>(write()); }),
              HasSubstr("or its folder may not be written to"));
  std::filesystem::permissions(path_, perms::none);
  EXPECT_THAT(failure_as_nobody(read_all), HasSubstr("Permission denied"));
  std::filesystem::permissions(inner, perms::all);
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

/// Writes a file with one byte at a place changed.
void damage(const std::filesystem::path& path, std::string bytes, std::size_t place) {
  bytes[place] ^= 1;
  std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
}

struct Salvaged {
  std::vector<std::size_t> edits;  // their numbers; all are as they were
  std::vector<std::string> faults;
};

Salvaged salvage(const Session& session) {
  Salvaged salvaged;
  salvaged.faults = session.salvage([&](std::uint64_t number, Edit&& one) {
    EXPECT_EQ(one, edit(number));
    salvaged.edits.push_back(number);
  });
  return salvaged;
}

std::vector<std::size_t> numbers(std::size_t count) {
  std::vector<std::size_t> all(count);
  std::iota(all.begin(), all.end(), 0U);
  return all;
}

TEST_F(SessionFile, OneDamagedEditLosesNoOther) {
  constexpr std::size_t count = 40;
  std::vector<Edit> edits;
  for (std::size_t i = 0; i < count; ++i) edits.push_back(edit(i));
  write().append(edits);
  EXPECT_EQ(salvage(read()).edits, numbers(count));
  const std::string good = read_file(path_);
  for (std::size_t i = 0; i < count; ++i) {
    const std::string line = to_line(edits[i]);
    const std::size_t place = good.find(line);
    damage(path_, good, place + line.size() / 2);
    auto others = numbers(count);
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    const Salvaged salvaged = salvage(read());
    EXPECT_EQ(salvaged.edits, others);
    const std::string name = "edit " + std::to_string(i);
    EXPECT_THAT(salvaged.faults, ElementsAre(name + ": damaged"));
    EXPECT_THAT([&] { static_cast<void>(all(write())); },
                ThrowsMessage<DamagedSession>(AllOf(HasSubstr(name + " is damaged"),
                                                    HasSubstr("verify"), HasSubstr("export"))));
    if (i + 1 == count) continue;  // there is none behind that tells it from a damaged edit
    damage(path_, good, place + line.size());
    EXPECT_EQ(salvage(read()).edits, numbers(count));
    EXPECT_THAT(salvage(read()).faults, ElementsAre(HasSubstr(name + ": only the checksum")));
  }
}

TEST_F(SessionFile, WhatIsLeftOfOneThatWasCutOffCanBeRead) {
  std::vector<Edit> edits;
  for (std::size_t i = 0; i < 500; ++i) edits.push_back(edit(i));
  write().append(edits);
  std::filesystem::resize_file(path_, std::filesystem::file_size(path_) / 8192 * 4096);
  EXPECT_THAT(read().check(), Contains(HasSubstr("invalid page number")));
  const Salvaged salvaged = salvage(read());
  EXPECT_GT(salvaged.edits.size(), 150U);
  EXPECT_EQ(salvaged.edits, numbers(salvaged.edits.size()));
  EXPECT_THAT(salvaged.faults, ElementsAre("edits from " + std::to_string(salvaged.edits.size()) +
                                           " on: cannot be read"));
  EXPECT_THAT([&] { static_cast<void>(write()); },
              ThrowsMessage<DamagedSession>(HasSubstr("session export")));
}

TEST_F(SessionFile, BehindAPageThatIsLostItGoesOn) {
  std::vector<Edit> edits;
  for (std::size_t i = 0; i < 500; ++i) edits.push_back(edit(i));
  write().append(edits);
  std::string bytes = read_file(path_);
  const std::size_t page = bytes.find(to_line(edits[250])) / 4096;
  bytes.replace(page * 4096, 4096, 4096, '\0');
  std::ofstream(path_, std::ios::binary | std::ios::trunc) << bytes;
  const Salvaged salvaged = salvage(read());
  EXPECT_GT(salvaged.edits.size(), 450U);
  EXPECT_EQ(salvaged.edits.back(), 499U);
  EXPECT_THAT(salvaged.faults,
              ElementsAre(HasSubstr(": cannot be read"), HasSubstr(": cannot be checked")));
}

TEST_F(SessionFile, WithAnyBitOfItsHeaderFlippedAllIsSavedOrTheCauseNamed) {
  std::vector<Edit> edits;
  for (std::size_t i = 0; i < 300; ++i) edits.push_back(edit(i));
  write().append(edits);
  const std::string good = read_file(path_);
  for (std::size_t bit = 0; bit < 800; ++bit) {
    std::string bytes = good;
    bytes[bit / 8] = static_cast<char>(bytes[bit / 8] ^ 1 << bit % 8);
    std::ofstream(path_, std::ios::binary | std::ios::trunc) << bytes;
    std::string words;
    try {
      const Salvaged salvaged = salvage(read());
      EXPECT_EQ(salvaged.edits.size(), edits.size()) << "byte " << bit / 8 << " bit " << bit % 8;
      if (!salvaged.faults.empty()) words = salvaged.faults.front();
    } catch (const std::exception& error) {
      ADD_FAILURE() << "byte " << bit / 8 << " bit " << bit % 8 << ": " << error.what();
    }
    const bool is_named = words.empty() || words.find("header is damaged") != std::string::npos;
    EXPECT_TRUE(is_named) << "byte " << bit / 8 << ": " << words;
    EXPECT_EQ(read_file(path_), bytes);  // it is not written to
  }
}

TEST_F(SessionFile, ADamagedHeaderIsNotWrittenOver) {
  write().append(std::vector{edit(0)});
  std::string bytes = read_file(path_);
  bytes[47] ^= 2;
  std::ofstream(path_, std::ios::binary | std::ios::trunc) << bytes;
  EXPECT_THROW(static_cast<void>(write()), DamagedSession);
  EXPECT_THROW(static_cast<void>(all(read())), DamagedSession);
  EXPECT_EQ(read_file(path_), bytes);
}

TEST_F(SessionFile, IsOneFileOnceItIsClosed) {
  write().append(std::vector{edit(0), edit(1)});
  const auto count = [&] {
    return std::distance(std::filesystem::directory_iterator(folder_),
                         std::filesystem::directory_iterator());
  };
  EXPECT_EQ(count(), 1);
  EXPECT_EQ(all(read()).size(), 2U);
  EXPECT_EQ(count(), 1);
  write().append(std::vector{edit(2)});
  EXPECT_EQ(count(), 1);
  EXPECT_EQ(all(read()).size(), 3U);
}

TEST_F(SessionFile, ALogThatIsMissingIsNamed) {
  const auto copy = folder_ / "copy.session";
  {
    Session session = write();
    session.append(std::vector{edit(0)});
    std::filesystem::copy_file(path_, copy);
  }
  std::string words;
  try {
    static_cast<void>(Session(copy, Session::Access::write));
  } catch (const DamagedSession& error) {
    words = error.what();
  }
  EXPECT_THAT(words, AllOf(HasSubstr("copy.session-wal"), HasSubstr("missing")));
}

/// As a process leaves it that is killed while it opens a session: the header says that there is a
/// log, and that is empty.
TEST_F(SessionFile, IsOpenedAgainAfterAKillWhileItWasOpened) {
  for (const bool is_new : {true, false}) {
    if (!is_new) write().append(std::vector{edit(0)});
    if (is_new) static_cast<void>(write());
    std::fstream file(path_, std::ios::binary | std::ios::in | std::ios::out);
    file.seekp(18);
    file.write("\2\2", 2);
    file.close();
    std::ofstream(path_.string() + "-wal");
    EXPECT_EQ(write().edit_count(), is_new ? 0U : 1U);
  }
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
