// SPDX-License-Identifier: MIT
#include "io/bytes/file.h"

#include <gtest/gtest.h>

#include <utility>

#include "tests/io/shapes.h"

namespace loft::io {
namespace {

using testing::Folder;

TEST(FileBytes, AreTheContent) {
  const Folder folder;
  FileBytes bytes(folder.write("a", "abc"));
  EXPECT_EQ(bytes.view(), "abc");
  const FileBytes moved = std::move(bytes);
  EXPECT_EQ(moved.view(), "abc");
  EXPECT_EQ(FileBytes(folder.write("empty", "")).view(), "");
}

TEST(FileBytes, AreMappedWhereTheyAreMany) {
  const Folder folder;
  const auto path = folder.write("large", "begin");
  const std::size_t size = (std::size_t{1} << 26) + 5;
  std::filesystem::resize_file(path, size);  // a hole, which takes no room
  FileBytes bytes(path);
  const FileBytes moved = std::move(bytes);
  ASSERT_EQ(moved.view().size(), size);
  EXPECT_EQ(moved.view().substr(0, 6), std::string_view("begin\0", 6));
  EXPECT_EQ(moved.view().back(), '\0');
}

TEST(FileBytes, OfWhatIsNoFileAreAnError) {
  const Folder folder;
  EXPECT_THROW(FileBytes(folder / "missing"), FileError);
  EXPECT_THROW(FileBytes(folder / ""), FileError);
}

}  // namespace
}  // namespace loft::io
