// SPDX-License-Identifier: MIT
#include "io/volumes/nrrd.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "io/bytes/file.h"
#include "reconstruct/defect.h"
#include "tests/io/bytes/gzipped.h"
#include "tests/io/stacks/readers.h"
#include "tests/io/volumes/masks.h"

namespace loft::io {
namespace {

using testing::encloses;
using testing::Folder;
using testing::gzipped;
using ::testing::HasSubstr;
using testing::problem;
using testing::read;
using testing::two_label_pixels;

/// Fields of 3 x 2 x 2 pixels, of which (1, 0) is 1 and (2, 1) is 2 in both slices.
std::string fields(const std::string& directions = "(2,0,0) (0,3,0) (0,0,5)") {
  return "NRRD0004\n# a comment\ntype: unsigned char\ndimension: 3\n"
         "space: left-posterior-superior\nsizes: 3 2 2\nspace directions: " +
         directions + "\nkinds: domain domain domain\nspace origin: (10,20,30)\n";
}

TEST(Nrrd, PixelsLieWhereTheFileHasThem) {
  const Stack stack = read(read_nrrd, fields() + "encoding: raw\n\n" + two_label_pixels);
  testing::expect_two_labels_in_place(stack);
  ASSERT_FALSE(stack.notes.empty());
  EXPECT_THAT(stack.notes.front(), HasSubstr("LPS"));
}

TEST(Nrrd, EveryEncodingIsTheSame) {
  const Stack expected = read(read_nrrd, fields() + "encoding: raw\n\n" + two_label_pixels);
  EXPECT_EQ(read(read_nrrd, fields() + "encoding: gzip\n\n" + gzipped(two_label_pixels)), expected);
  EXPECT_EQ(read(read_nrrd, fields() + "encoding: ascii\n\n0 1 0 0 0 2\n0 1 0 0 0 2\n"), expected);
  EXPECT_EQ(read(read_nrrd, fields() + "encoding: raw\nline skip: 1\nbyte skip: 2\n\nwords\nxx" +
                                two_label_pixels),
            expected);
}

TEST(Nrrd, NegativeDirectionsTurnTheImage) {
  const Stack stack =
      read(read_nrrd, fields("(-2,0,0) (0,-3,0) (0,0,5)") + "encoding: raw\n\n" + two_label_pixels);
  EXPECT_TRUE(encloses(stack.slices[0], "1", {8, 20}));
  EXPECT_TRUE(encloses(stack.slices[0], "2", {6, 17}));
}

TEST(Nrrd, SegmentsHaveNamesAndColours) {
  const Stack stack = read(read_nrrd, fields() +
                                          "encoding: raw\nSegment0_ID:=S_1\nSegment0_Name:=heart\n"
                                          "Segment0_Color:=1 0.50196 0\nSegment0_LabelValue:=2\n"
                                          "Segment0_Layer:=0\n\n" +
                                          two_label_pixels);
  const StackLabel* const heart = stack.find_label("heart");
  ASSERT_NE(heart, nullptr);
  EXPECT_EQ(heart->colour, (Colour{255, 128, 0}));
  EXPECT_EQ(heart->id, "S_1");
  EXPECT_TRUE(encloses(stack.slices[0], "heart", {14, 23}));
}

/// Two layers of 2 x 1 x 2 pixels, both with (0, 0).
std::string layers(const std::string& sizes, const std::string& directions,
                   const std::string& kinds) {
  return "NRRD0004\ntype: uint8\ndimension: 4\nspace: RAS\nsizes: " + sizes +
         "\nspace directions: " + directions + "\nkinds: " + kinds + "\nencoding: raw\n";
}

TEST(Nrrd, LayersMayOverlap) {
  const std::string segments =
      "Segment0_ID:=a\nSegment0_Layer:=0\nSegment0_LabelValue:=1\n"
      "Segment1_ID:=b\nSegment1_Layer:=1\nSegment1_LabelValue:=1\n\n";
  const Stack first = read(
      read_nrrd, layers("2 2 1 2", "none (1,0,0) (0,1,0) (0,0,1)", "list domain domain domain") +
                     segments + std::string("\1\1\0\1\1\1\0\1", 8));
  EXPECT_TRUE(encloses(first.slices[0], "a", {0, 0}));
  EXPECT_TRUE(encloses(first.slices[0], "b", {0, 0}));
  EXPECT_FALSE(encloses(first.slices[0], "a", {1, 0}));
  EXPECT_TRUE(encloses(first.slices[0], "b", {1, 0}));
}

TEST(Nrrd, OldFilesHaveALayerForEachSegment) {
  const Stack stack = read(
      read_nrrd,
      layers("2 1 2 2", "(1,0,0,0) (0,1,0,0) (0,0,1,0) (0,0,0,1)", "domain domain domain domain") +
          "Segment0_ID:=a\nSegment1_ID:=b\n\n" + std::string("\1\0\1\0\0\1\0\1", 8));
  EXPECT_TRUE(encloses(stack.slices[1], "a", {0, 0}));
  EXPECT_TRUE(encloses(stack.slices[1], "b", {1, 0}));
  EXPECT_FALSE(encloses(stack.slices[1], "b", {0, 0}));
}

TEST(Nrrd, PixelsMayBeInAFileBesideIt) {
  const Folder folder;
  static_cast<void>(folder.write("a.raw", two_label_pixels));
  const std::string header = fields() + "encoding: raw\ndata file: a.raw\n";
  const Stack stack = read_nrrd({header, "a.nhdr", folder / ""}, {});
  EXPECT_EQ(stack.slices.size(), 2U);
  for (const std::string file : {"../a.raw", "/etc/passwd", "none.raw", "LIST", "a%d.raw"})
    EXPECT_THAT(testing::message_of<InputError>([&] {
                  const std::string other = fields() + "encoding: raw\ndata file: " + file + "\n";
                  static_cast<void>(read_nrrd({other, "a.nhdr", folder / ""}, {}));
                }),
                HasSubstr("data file"));
}

TEST(Nrrd, SpacingIsAskedForWhereThereIsNone) {
  const std::string file =
      "NRRD0001\ntype: uchar\ndimension: 3\nsizes: 3 2 2\nencoding: raw\n\n" + two_label_pixels;
  EXPECT_THAT(problem(read_nrrd, file), HasSubstr("--spacing"));
  const Stack stack = read(read_nrrd, file, {.spacing = Vec3{1, 1, 4}});
  EXPECT_EQ(stack.slices[1].z - stack.slices[0].z, 4);
}

TEST(Nrrd, SaysWhatIsWrong) {
  const std::string good = fields() + "encoding: raw\n\n" + two_label_pixels;
  const auto with = [&](const std::string& what, const std::string& by) {
    std::string bad = good;
    bad.replace(bad.find(what), what.size(), by);
    return problem(read_nrrd, bad);
  };
  EXPECT_THAT(problem(read_nrrd, "P5\n"), HasSubstr("NRRD000"));
  EXPECT_THAT(with("unsigned char", "block"), HasSubstr("type"));
  EXPECT_THAT(with("dimension: 3", "dimension: 7"), HasSubstr("dimension"));
  EXPECT_THAT(with("sizes: 3 2 2", "sizes: 3 2"), HasSubstr("sizes"));
  EXPECT_THAT(with("sizes: 3 2 2", "sizes: 3 -2 2"), HasSubstr("sizes"));
  EXPECT_THAT(with("sizes: 3 2 2", "sizes: 4000000000 4000000000 4000000000"), HasSubstr("sizes"));
  EXPECT_THAT(with("sizes: 3 2 2", "sizes: 30000 20000 2"), HasSubstr("cut off"));
  EXPECT_THAT(with("(2,0,0)", "(2,0)"), HasSubstr("space directions"));
  EXPECT_THAT(with("encoding: raw", "encoding: hex"), HasSubstr("encoding"));
  EXPECT_NE(with("(0,3,0)", "(2,0,0)"), "") << "a singular matrix";
  EXPECT_NE(with("(0,3,0)", "(0,nan,0)"), "");
}

TEST(Nrrd, IsRefusedCutOffAnywhere) {
  const std::string good = fields() + "encoding: gzip\n\n" + gzipped(two_label_pixels);
  for (std::size_t size = 0; size < good.size(); ++size)
    EXPECT_NE(problem(read_nrrd, good.substr(0, size)), "") << size;
}

}  // namespace
}  // namespace loft::io
