// SPDX-License-Identifier: MIT
#include "app/capture/edit_source.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>
#include <string>
#include <vector>

#include "io/bytes/file.h"
#include "tests/io/shapes.h"

namespace loft::app {
namespace {

using io::testing::Folder;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using State = EditSource::State;

class Source : public ::testing::Test {
 protected:
  Folder folder_;
  std::filesystem::path path_ = folder_ / "in.ndjson";
  std::vector<std::string> words_;

  EditSource::Setup setup(bool is_followed) {
    EditSource::Setup setup;
    setup.path = path_;
    setup.is_followed = is_followed;
    setup.most_bytes = 1000;
    setup.say = [this](const std::string& words) { words_.push_back(words); };
    return setup;
  }

  void write(const std::string& text, std::ios::openmode mode = std::ios::app) const {
    std::ofstream(path_, std::ios::binary | mode) << text;
  }

  /// The lines that are there now, each with its number; `too long` for one of those.
  static std::vector<std::string> read(EditSource& source) {
    std::vector<std::string> lines;
    std::string line;
    for (;;) {
      const State state = source.next(line, std::chrono::milliseconds(1));
      if (state != State::line && state != State::too_long) return lines;
      lines.push_back(std::to_string(source.line_number()) + ' ' +
                      (state == State::line ? line : "too long"));
    }
  }
};

TEST_F(Source, AFileThatIsReplacedIsReadToItsEndFirst) {
  write("a\nb\n");
  EditSource source(setup(true));
  EXPECT_THAT(read(source), ElementsAre("1 a", "2 b"));
  write("c\nno end");
  std::filesystem::rename(path_, folder_ / "old");
  write("d\n");
  EXPECT_THAT(read(source), ElementsAre("3 c", "4 no end", "1 d"));
  write("e\n");
  EXPECT_THAT(read(source), ElementsAre("2 e"));
}

TEST_F(Source, AsLongAsTheNextFileIsEmptyTheOldOneMayGrow) {
  write("a\n");
  EditSource source(setup(true));
  EXPECT_THAT(read(source), ElementsAre("1 a"));
  std::filesystem::rename(path_, folder_ / "old");
  write("");
  EXPECT_THAT(read(source), ElementsAre());
  std::ofstream(folder_ / "old", std::ios::app) << "b\n";
  EXPECT_THAT(read(source), ElementsAre("2 b"));
  write("c\n");
  EXPECT_THAT(read(source), ElementsAre("1 c"));
}

TEST_F(Source, AFileThatGetsShorterIsReadFromItsBeginning) {
  write("first\nsecond\nhal");
  EditSource source(setup(true));
  EXPECT_THAT(read(source), ElementsAre("1 first", "2 second"));
  write("new\n", std::ios::trunc);
  EXPECT_THAT(read(source), ElementsAre("1 new"));
  EXPECT_THAT(words_, ElementsAre(HasSubstr("in.ndjson has become shorter")));
}

TEST_F(Source, AFileThatIsNotThereIsAwaitedAloud) {
  EditSource source(setup(true));
  EXPECT_THAT(read(source), ElementsAre());
  EXPECT_THAT(words_, ElementsAre(HasSubstr("waiting for ")));
  write("a\n");
  EXPECT_THAT(read(source), ElementsAre("1 a"));
  EXPECT_EQ(words_.size(), 1U);
  std::filesystem::remove(path_);
  EXPECT_THROW(EditSource other(setup(false)), io::FileError);
}

TEST_F(Source, AFolderCannotBeRead) {
  write("a\n");
  EditSource source(setup(true));
  EXPECT_THAT(read(source), ElementsAre("1 a"));
  std::filesystem::remove(path_);
  std::filesystem::create_directory(path_);
  EXPECT_THROW(read(source), io::FileError);
  EXPECT_THROW(EditSource other(setup(true)), io::FileError);
}

TEST_F(Source, AFifoGoesOnWithItsNextWriter) {
  ASSERT_EQ(::mkfifo(path_.c_str(), 0600), 0);
  EditSource source(setup(true));
  EXPECT_THAT(read(source), ElementsAre());
  int writer = ::open(path_.c_str(), O_WRONLY | O_NONBLOCK);
  const auto send = [&](const std::string& text) {
    return ::write(writer, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  };
  ASSERT_TRUE(send("first h"));
  EXPECT_THAT(read(source), ElementsAre());
  ASSERT_TRUE(send("alf\nsec"));
  EXPECT_THAT(read(source), ElementsAre("1 first half"));
  ::close(writer);
  EXPECT_THAT(read(source), ElementsAre());
  EXPECT_EQ(source.unfinished_bytes(), 3U);
  writer = ::open(path_.c_str(), O_WRONLY | O_NONBLOCK);
  ASSERT_TRUE(send("ond\n"));
  EXPECT_THAT(read(source), ElementsAre("2 second"));
  ::close(writer);
  EXPECT_FALSE(source.position());
}

TEST_F(Source, AFifoThatIsNotFollowedEndsWithItsWriter) {
  ASSERT_EQ(::mkfifo(path_.c_str(), 0600), 0);
  EditSource source(setup(false));
  std::string line;
  const std::chrono::milliseconds patience(1);
  EXPECT_EQ(source.next(line, patience), State::waiting);
  const int writer = ::open(path_.c_str(), O_WRONLY | O_NONBLOCK);
  ASSERT_EQ(::write(writer, "a\nb", 3), 3);
  ::close(writer);
  EXPECT_THAT(read(source), ElementsAre("1 a", "2 b"));
  EXPECT_EQ(source.next(line, patience), State::ended);
}

TEST_F(Source, LinesThatAreTooLongAreLeftOut) {
  write("a\n" + std::string(1000, 'x') + '\n' + std::string(1001, 'y') + "\nb\n" +
        std::string(300'000, 'z') + "\nc\n" + std::string(5000, 'w'));
  EditSource source(setup(false));
  EXPECT_THAT(read(source), ElementsAre("1 a", "2 " + std::string(1000, 'x'), "3 too long", "4 b",
                                        "5 too long", "6 c", "7 too long"));
}

TEST_F(Source, AMarkInFrontIsNoPartOfTheFirstLine) {
  write(
      "\xEF\xBB\xBF"
      "a\n\xEF\xBB\xBF"
      "b\n");
  EditSource source(setup(true));
  EXPECT_THAT(read(source), ElementsAre("1 a",
                                        "2 \xEF\xBB\xBF"
                                        "b"));
  std::filesystem::rename(path_, folder_ / "old");
  write(
      "\xEF\xBB\xBF"
      "c\n");
  EXPECT_THAT(read(source), ElementsAre("1 c"));
}

TEST_F(Source, AFileHasOnePositionWhateverLinksLeadToIt) {
  write("a\n");
  std::filesystem::create_symlink(path_, folder_ / "link");
  EXPECT_EQ(EditSource::full_name(folder_ / "link"), EditSource::full_name(path_));
  EXPECT_EQ(EditSource::full_name("not_there"), std::filesystem::current_path() / "not_there");
}

TEST_F(Source, GoesOnWhereItWas) {
  write("a\nb\nc");
  std::vector<std::optional<io::InputPosition>> positions;
  {
    EditSource source(setup(false));
    std::string line;
    while (source.next(line, std::chrono::milliseconds(1)) == State::line)
      positions.push_back(source.position());
  }
  ASSERT_EQ(positions.size(), 3U);
  write("\nd\n");
  const auto resumed = [&](const std::optional<io::InputPosition>& start) {
    EditSource::Setup wanted = setup(false);
    wanted.start = start;
    EditSource source(wanted);
    return read(source);
  };
  EXPECT_THAT(resumed(positions[0]), ElementsAre("2 b", "3 c", "4 d"));
  EXPECT_THAT(resumed(positions[1]), ElementsAre("3 c", "4 d"));
  EXPECT_THAT(resumed(positions[2]), ElementsAre("3 ", "4 d"));  // what is left of line 3
  EXPECT_THAT(words_.front(), HasSubstr("resumed at line 2 of "));

  write("a\nB\nc\nd\n", std::ios::trunc);
  EXPECT_THAT(resumed(positions[0]), ElementsAre("2 B", "3 c", "4 d"));
  EXPECT_THAT(resumed(positions[1]), ElementsAre("1 a", "2 B", "3 c", "4 d"));
  EXPECT_THAT(words_.back(), HasSubstr("is not the file any more"));
  write("a", std::ios::trunc);
  EXPECT_THAT(resumed(positions[0]), ElementsAre("1 a"));
}

}  // namespace
}  // namespace loft::app
