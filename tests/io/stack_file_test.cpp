// SPDX-License-Identifier: MIT
#include "io/stack_file.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "io/bytes/file.h"
#include "io/stack.h"
#include "tests/io/shapes.h"

namespace loft::io {
namespace {

using testing::Folder;
using testing::message_of;

const std::string first =
    "\xEF\xBB\xBF{\"z\": 2, \"contours\": [[[0,0],[1,0],[1,1]], []]}\r\n"
    "\n   \n"
    "{\"labels\": [\"a\"], \"contours\": [[[5,5],[6,5],[5,6]]], \"z\": -1.5}\n";
const std::string second = "{\"z\": 7, \"contours\": []}";  // without a line end

TEST(StackFile, FindsEverySliceAgain) {
  const Folder folder;
  const std::vector<std::filesystem::path> paths{folder.write("a.ndjson", first),
                                                 folder.write("b.ndjson", second)};
  const std::vector<Slice> slices = read_stack(paths).slices;
  std::vector<Slice> seen;
  double last_share = 0;
  const StackFile stack(paths, {.threads = 2}, [&](const Slice& slice, double share) {
    seen.push_back(slice);
    EXPECT_GE(share, last_share);
    last_share = share;
  });
  EXPECT_EQ(seen, slices);
  EXPECT_LE(last_share, 1);
  const SliceSource source = stack.source();
  ASSERT_EQ(source.slices.size(), 3U);
  for (const std::uint32_t i : {2U, 0U, 1U}) {
    EXPECT_EQ(source.read(i), slices[i]);
    EXPECT_EQ(source.slices[i].z, slices[i].z);
  }
  EXPECT_EQ(source.slices[0].points, 3U);
}

TEST(StackFile, NoticesThatTheFileChanges) {
  const Folder folder;
  const std::vector paths{folder.write("a.ndjson", first)};
  const StackFile stack(paths, {.threads = 1}, [](const Slice&, double) {});
  for (const std::string& text : {second, std::string(), "x" + first}) {
    static_cast<void>(folder.write("a.ndjson", text));
    EXPECT_THROW(static_cast<void>(stack.read(0)), FileError);
  }
}

TEST(StackFile, RefusesWhatReadSlicesRefuses) {
  const Folder folder;
  const auto refuse = [](const std::filesystem::path& path) {
    const std::vector paths{path};
    StackFile(paths, {.threads = 1}, [](const Slice&, double) {});
  };
  for (const auto& path : {folder.write("a.ndjson", "{}\n[]"), folder.write("b.json", "\n")}) {
    const std::string message = message_of<InputError>([&] { refuse(path); });
    EXPECT_EQ(message, message_of<InputError>([&] { static_cast<void>(read_stack(path)); }));
  }
  const auto unknown = folder.write("a.svg", second);
  EXPECT_THROW(refuse(unknown), UnknownFormat);
  EXPECT_THROW(refuse(folder / "missing.ndjson"), FileError);
  EXPECT_THROW(refuse(folder / ""), FileError);
  EXPECT_THROW(refuse("-"), FileError);
}

}  // namespace
}  // namespace loft::io
