// SPDX-License-Identifier: MIT
// `loft stream --session` and `loft session` where files and descriptors are not as they should be.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <string>

#include "tests/app/program.h"

namespace loft::app {
namespace {

using namespace testing;
using ::testing::HasSubstr;

/// The exit code of `loft ARGUMENTS` in the folder; redirections are part of them.
int exit_code(const Folder& folder, const std::string& arguments) {
  const std::string command = "cd '" + (folder / "").string() + "' && \"$LOFT\" " + arguments;
  const int status = std::system(command.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/// A session with the five slices of a barrel.
void begin_session(const Folder& folder) {
  std::ofstream(folder / "five.ndjson") << barrel();
  ASSERT_EQ(run(folder, "stream five.ndjson --session c.session").exit_code, 0);
}

TEST(Descriptors, ThatAreClosedDoNotBecomeTheSession) {
  const Folder folder;
  begin_session(folder);
  const std::string words = "stream bad.ndjson --session c.session --json";
  std::ofstream(folder / "bad.ndjson") << "no edit\n";
  EXPECT_EQ(exit_code(folder, words + " >/dev/null 2>&-"), 0);
  EXPECT_EQ(exit_code(folder, words + " 2>/dev/null >&-"), 4);
  EXPECT_EQ(exit_code(folder, "stream --session c.session 2>err.txt <&-"), 0);
  EXPECT_THAT(content(folder / "err.txt"), HasSubstr("5 edits, 0 rejected"));
  EXPECT_EQ(run(folder, "session verify c.session").exit_code, 0);
}

TEST(StandardOutput, ThatCannotBeWrittenIsNoticed) {
  const Folder folder;
  begin_session(folder);
  for (const std::string words :
       {"session list c.session", "session export c.session", "session verify c.session",
        "info five.ndjson --json", "stream five.ndjson --json",
        "reconstruct five.ndjson -o five.ply --json", "check five.ply --json", "--version"}) {
    EXPECT_EQ(exit_code(folder, words + " >/dev/full 2>err.txt"), 4) << words;
    EXPECT_THAT(content(folder / "err.txt"), HasSubstr("cannot write to standard output")) << words;
  }
}

TEST(SessionExport, ThatFailsLeavesTheOldFile) {
  const Folder folder;
  std::ofstream(folder / "keep.ndjson") << "kept";
  EXPECT_EQ(run(folder, "session export missing.session -o keep.ndjson").exit_code, 3);
  EXPECT_EQ(content(folder / "keep.ndjson"), "kept");
}

TEST(SessionExport, SavesAllThatIsSound) {
  const Folder folder;
  begin_session(folder);
  std::string bytes = content(folder / "c.session");
  const std::size_t place = bytes.find(R"({"z":2)");
  ASSERT_NE(place, std::string::npos);
  bytes[place + 30] ^= 1;
  std::ofstream(folder / "c.session", std::ios::binary) << bytes;
  const Outcome verified = run(folder, "session verify c.session");
  EXPECT_EQ(verified.exit_code, 1);
  EXPECT_THAT(verified.err, HasSubstr("edit 2: damaged"));
  const Outcome exported = run(folder, "session export c.session -o out.ndjson");
  EXPECT_EQ(exported.exit_code, 3);
  EXPECT_THAT(exported.err, HasSubstr("c.session: edit 2: damaged"));
  const std::string saved = content(folder / "out.ndjson");
  EXPECT_EQ(std::ranges::count(saved, '\n'), 4);
  EXPECT_THAT(saved, HasSubstr(R"({"z":4)"));
}

TEST(SessionExport, SavesAReplacementOfWhatIsLost) {
  const Folder folder;
  std::ofstream(folder / "stdin") << slice(2, ring(3)) << R"({"op": "replace",)"
                                  << slice(2, ring(5)).substr(1);
  ASSERT_EQ(run(folder, "stream --session c.session").exit_code, 0);
  std::string bytes = content(folder / "c.session");
  bytes[bytes.find(R"({"z":2)") + 30] ^= 1;
  std::ofstream(folder / "c.session", std::ios::binary) << bytes;
  EXPECT_THAT(run(folder, "session export c.session").out, HasSubstr(R"({"z":2)"));
}

TEST(SessionVerify, FailsOtherwiseWhereItCannotRead) {
  const Folder folder;
  std::ofstream(folder / "no.session") << "no session";
  EXPECT_EQ(run(folder, "session verify no.session").exit_code, 3);
  EXPECT_EQ(run(folder, "session verify .").exit_code, 3);
}

}  // namespace
}  // namespace loft::app
