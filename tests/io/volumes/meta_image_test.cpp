// SPDX-License-Identifier: MIT
#include "io/volumes/meta_image.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "io/volumes/meta_image_header.h"
#include "tests/io/bytes/gzipped.h"
#include "tests/io/stacks/readers.h"
#include "tests/io/volumes/masks.h"

namespace loft::io {
namespace {

using testing::append;
using testing::deflated;
using testing::differing_pixels;
using ::testing::ElementsAre;
using testing::encloses;
using testing::Folder;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::number_as_name;
using testing::problem;
using testing::read;
using testing::two_label_pixels;
using testing::two_label_slice;

/// Fields of 3 x 2 x 2 pixels, of which (1, 0) is 1 and (2, 1) is 2 in both slices.
struct MadeMetaImage {
  std::string type = "MET_UCHAR";
  std::string size = "3 2 2";
  std::string place =
      "TransformMatrix = 1 0 0 0 1 0 0 0 1\nOffset = 10 20 30\nElementSpacing = 2 3 5\n";
  std::string more{};
  std::string dimensions = "3";

  [[nodiscard]] std::string header(const std::string& file) const {
    return "ObjectType = Image\nNDims = " + dimensions + "\nBinaryData = True\n" + place + more +
           "DimSize = " + size + "\nElementType = " + type + "\nElementDataFile = " + file + "\n";
  }
  [[nodiscard]] std::string local(const std::string& content) const {
    return header("LOCAL") + content;
  }
};

Stack expected() { return read(read_meta_image, MadeMetaImage().local(two_label_pixels)); }

Stack read_in(const Folder& folder, const std::string& header) {
  return read_meta_image({header, "a.mhd", folder / ""}, {});
}
std::string problem_in(const Folder& folder, const std::string& header) {
  return testing::message_of<InputError>([&] { static_cast<void>(read_in(folder, header)); });
}

TEST(MetaImage, PixelsLieWhereTheFileHasThem) {
  const Stack stack = expected();
  testing::expect_two_labels_in_place(stack);
  EXPECT_THAT(stack.notes, ::testing::Contains(HasSubstr("LPS")));
}

TEST(MetaImage, RowsOfTheMatrixAreAxes) {
  MadeMetaImage made;
  // Columns run along y, rows along -x: as columns of the matrix they would run the other way.
  made.place = "Rotation = 0 1 0 -1 0 0 0 0 1\nPosition = 10 20 30\nElementSpacing = 2 3 5\n";
  const Stack stack = read(read_meta_image, made.local(two_label_pixels));
  EXPECT_FALSE(stack.frame);
  EXPECT_TRUE(encloses(stack.slices[0], "1", {10, 22}));
  EXPECT_TRUE(encloses(stack.slices[0], "2", {7, 24}));
}

TEST(MetaImage, TiltedAxesHaveAFrame) {
  MadeMetaImage made;
  made.place = "TransformMatrix = 1 0 0 0 0.6 0.8 0 -0.8 0.6\nElementSpacing = 2 3 5\n";
  const Stack stack = read(read_meta_image, made.local(two_label_pixels));
  ASSERT_TRUE(stack.frame);
  const Vec3 place = stack.frame->at({0, 3, 0});  // of the first pixel of the second row
  EXPECT_NEAR(place[1], 3 * 0.6, 1e-12);
  EXPECT_NEAR(place[2], 3 * 0.8, 1e-12);
}

TEST(MetaImage, OutlinesEncloseItsPixelsAndNoOthers) {
  const auto seed = std::random_device{}();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937_64 random(seed);
  const std::vector<int> labels = testing::random_labels(std::size_t{9} * 8 * 4, 4, random);
  std::string bytes;
  for (const int label : labels) append(bytes, static_cast<std::int16_t>(label), std::endian::big);
  MadeMetaImage made{.type = "MET_SHORT", .size = "9 8 4", .place = "ElementSpacing = 2 3 5\n"};
  made.more = "CompressedData = True\nBinaryDataByteOrderMSB = True\n";
  for (const Outline outline : {Outline::iso_lines, Outline::edges}) {
    const Stack stack = read(read_meta_image, made.local(deflated(bytes)), {.outline = outline});
    EXPECT_EQ(differing_pixels(stack, 9, 8, labels, number_as_name, 2, 3), 0U);
  }
}

TEST(MetaImage, EveryTypeOfNumberIsRead) {
  const auto bytes_of = [](auto number, std::endian order) {
    std::string bytes;
    for (const char label : two_label_pixels)
      append(bytes, static_cast<decltype(number)>(label), order);
    return bytes;
  };
  for (const std::endian order : {std::endian::little, std::endian::big}) {
    const auto expect = [&](const std::string& type, const std::string& bytes) {
      MadeMetaImage made;
      made.type = type;
      if (order == std::endian::big) made.more = "ElementByteOrderMSB = True\n";
      EXPECT_EQ(read(read_meta_image, made.local(bytes)), expected()) << type;
    };
    expect("MET_CHAR", bytes_of(std::int8_t{}, order));
    expect("MET_USHORT", bytes_of(std::uint16_t{}, order));
    expect("MET_SHORT", bytes_of(std::int16_t{}, order));
    expect("MET_UINT", bytes_of(std::uint32_t{}, order));
    expect("MET_INT", bytes_of(std::int32_t{}, order));
    expect("MET_ULONG", bytes_of(std::uint32_t{}, order));
    expect("MET_LONG", bytes_of(std::int32_t{}, order));
    expect("MET_ULONG_LONG", bytes_of(std::uint64_t{}, order));
    expect("MET_LONG_LONG", bytes_of(std::int64_t{}, order));
    expect("MET_FLOAT", bytes_of(float{}, order));
    expect("MET_DOUBLE", bytes_of(double{}, order));
  }
}

TEST(MetaImage, ZlibHasNoHeaderOfGzipAndItsSizeMayBeLeftOut) {
  MadeMetaImage made;
  made.more = "CompressedData = True\n";
  EXPECT_EQ(read(read_meta_image, made.local(deflated(two_label_pixels))), expected());
  made.more += "CompressedDataSize = " + std::to_string(deflated(two_label_pixels).size()) + '\n';
  EXPECT_EQ(read(read_meta_image, made.local(deflated(two_label_pixels) + "behind")), expected());
  made.more = "CompressedData = True\nCompressedDataSize = 2147483648\n";
  EXPECT_THAT(problem(read_meta_image, made.local(deflated(two_label_pixels))),
              HasSubstr("it was cut off"));
}

TEST(MetaImage, NumbersMayBeText) {
  std::string file = MadeMetaImage().local("0 1 0 0 0 2\n0 1 0\r\n0 0 2\n");
  file.replace(file.find("True"), 4, "False");
  EXPECT_EQ(read(read_meta_image, file), expected());
}

TEST(MetaImage, ALocalFileMayHaveAHeaderInFrontOfItsPixels) {
  MadeMetaImage made;
  made.more = "HeaderSize = 4\n";
  EXPECT_EQ(read(read_meta_image, made.local("head" + two_label_pixels)), expected());
}

TEST(MetaImage, PixelsMayBeInAFileBesideIt) {
  const Folder folder;
  static_cast<void>(folder.write("a b.raw", two_label_pixels));
  static_cast<void>(folder.write("a.zraw", deflated(two_label_pixels)));
  EXPECT_EQ(read_in(folder, MadeMetaImage().header("a b.raw")).slices, expected().slices);
  MadeMetaImage made;
  made.more = "CompressedData = True\n";
  EXPECT_EQ(read_in(folder, made.header("a.zraw")).slices, expected().slices);
  for (const std::string file : {"../a b.raw", "/etc/passwd", "none.raw", "..", "."})
    EXPECT_THAT(problem_in(folder, MadeMetaImage().header(file)), HasSubstr("ElementDataFile"))
        << file;
}

TEST(MetaImage, AHeaderSizeOfMinusOneMeansTheLastOfTheFile) {
  const Folder folder;
  static_cast<void>(folder.write("a.raw", "a head of any size" + two_label_pixels));
  MadeMetaImage made;
  made.more = "HeaderSize = -1\n";
  EXPECT_EQ(read_in(folder, made.header("a.raw")).slices, expected().slices);
  static_cast<void>(folder.write("a.raw", "x"));
  EXPECT_THAT(problem_in(folder, made.header("a.raw")), HasSubstr("it was cut off"));
}

TEST(MetaImage, SlicesMayBeInAListOfFiles) {
  const Folder folder;
  static_cast<void>(folder.write("low.raw", two_label_slice));
  static_cast<void>(folder.write("high.raw", two_label_slice));
  EXPECT_EQ(read_in(folder, MadeMetaImage().header("LIST") + "low.raw\r\nhigh.raw\r\n").slices,
            expected().slices);
  EXPECT_EQ(read_in(folder, MadeMetaImage().header("LIST 2D") + "low.raw\nhigh.raw").slices,
            expected().slices);
  EXPECT_THAT(problem_in(folder, MadeMetaImage().header("LIST") + "low.raw\n"),
              HasSubstr("but has 1"));
  EXPECT_THAT(problem_in(folder, MadeMetaImage().header("LIST") + "low.raw\nhigh.raw\nx.raw\n"),
              HasSubstr("but has more"));
  EXPECT_THAT(problem_in(folder, MadeMetaImage().header("LIST") + "low.raw\nlow.raw\n"),
              HasSubstr("twice"));
  EXPECT_THAT(problem_in(folder, MadeMetaImage().header("LIST 1D") + "low.raw\nhigh.raw\n"),
              HasSubstr("less than a slice"));
  EXPECT_THAT(problem_in(folder, MadeMetaImage().header("LIST") + "low.raw\n/etc/passwd\n"),
              HasSubstr("is not beside the header"));
}

TEST(MetaImage, SlicesMayBeInFilesByAPattern) {
  const Folder folder;
  static_cast<void>(folder.write("s008.raw", two_label_slice));
  static_cast<void>(folder.write("s010.raw", two_label_slice));
  EXPECT_EQ(read_in(folder, MadeMetaImage().header("s%03d.raw 8 10 2")).slices, expected().slices);
  EXPECT_THAT(problem_in(folder, MadeMetaImage().header("s%03d.raw 8 10 1")),
              HasSubstr("does not name the files of 2 slices"));
  EXPECT_THAT(problem_in(folder, MadeMetaImage().header("s%03d.raw 9 11 2")),
              HasSubstr("'s009.raw'"));
}

TEST(MetaImage, PatternsAreNothingButANumber) {
  EXPECT_THAT(names_by_pattern("a%d.raw", 2), ElementsAre("a1.raw", "a2.raw"));
  EXPECT_THAT(names_by_pattern("a%03d.raw 9 10", 2), ElementsAre("a009.raw", "a010.raw"));
  EXPECT_THAT(names_by_pattern("%2i 9 13 4", 2), ElementsAre(" 9", "13"));
  for (const char* const bad :
       {"a%s 1 2 1", "a%n 1 2 1", "a%d%d 1 2 1", "a% 1 2 1", "a%9999d 1 2 1", "a%d 2 1 1",
        "a%d 1 2 0", "a%d 1 2 -1", "a%d x", "a%d 1 2 1 5", "a 1 2 1", "a%03", "%*d 1 2 1", "",
        "a%d 1 99999999999999999999 1"})
    EXPECT_THAT(names_by_pattern(bad, 2), IsEmpty()) << bad;
  EXPECT_THAT(names_by_pattern("a%d", 4'000'000'000), IsEmpty());
}

TEST(MetaImage, AFourthAxisIsThatOfLayers) {
  MadeMetaImage made;
  made.dimensions = "4";
  made.size = "3 2 1 2";
  made.place =
      "TransformMatrix = 1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1\nOffset = 0 0 0 0\n"
      "ElementSpacing = 2 3 5 1\n";
  const Stack stack = read(read_meta_image, made.local(two_label_pixels));
  ASSERT_EQ(stack.slices.size(), 1U);
  EXPECT_EQ(stack.slices[0].contours.size(), 4U);
}

TEST(MetaImage, FloatsFromZeroToOneAreShares) {
  MadeMetaImage made;
  made.type = "MET_FLOAT";
  std::string bytes;
  for (const float share : {0.F, 0.75F, 0.F, 0.F, 0.F, 0.25F, 0.F, 1.F, 0.F, 0.F, 0.F, 0.F})
    append(bytes, share, std::endian::little);
  const Stack stack = read(read_meta_image, made.local(bytes));
  EXPECT_EQ(stack.slices[0].contours.size(), 1U);
  EXPECT_EQ(stack.slices[1].contours.size(), 1U);
}

TEST(MetaImage, SpacingIsAskedForWhereThereIsNone) {
  MadeMetaImage made;
  made.place = "";
  EXPECT_THAT(problem(read_meta_image, made.local(two_label_pixels)), HasSubstr("--spacing"));
  made.place = "ElementSpacing = 2 3 0\n";
  EXPECT_THAT(problem(read_meta_image, made.local(two_label_pixels)), HasSubstr("--spacing"));
  const Stack stack =
      read(read_meta_image, made.local(two_label_pixels), {.spacing = Vec3{1, 1, 4}});
  EXPECT_EQ(stack.slices[1].z - stack.slices[0].z, 4);
}

TEST(MetaImage, SaysWhatIsWrong) {
  const std::string good = MadeMetaImage().local(two_label_pixels);
  const auto with = [&](const std::string& what, const std::string& by) {
    std::string bad = good;
    bad.replace(bad.find(what), what.size(), by);
    return problem(read_meta_image, bad);
  };
  EXPECT_EQ(with("3 2 2", "3 2 2"), "nothing");
  EXPECT_THAT(problem(read_meta_image, "P5\n"), HasSubstr("line 1: 'P5'"));
  EXPECT_THAT(with("= Image", "= Tube"), HasSubstr("ObjectType"));
  EXPECT_THAT(with("NDims = 3", "NDims = 7"), HasSubstr("NDims"));
  EXPECT_THAT(with("3 2 2", "3 2"), HasSubstr("DimSize"));
  EXPECT_THAT(with("3 2 2", "3 -2 2"), HasSubstr("DimSize"));
  EXPECT_THAT(with("3 2 2", "2147483648 2147483648 2147483648"), HasSubstr("DimSize"));
  EXPECT_THAT(with("3 2 2", "30000 20000 2"), HasSubstr("it was cut off"));
  EXPECT_THAT(with("MET_UCHAR", "MET_STRING"), HasSubstr("ElementType"));
  EXPECT_THAT(with("1 0 0 0 1 0 0 0 1", "1 0 0 0 1 0 0 0"), HasSubstr("TransformMatrix"));
  EXPECT_THAT(with("1 0 0 0 1 0 0 0 1", "1 0 0 1 0 0 0 0 1"), HasSubstr("singular"));
  EXPECT_THAT(with("10 20 30", "10 nan 30"), HasSubstr("Offset"));
  EXPECT_THAT(with("BinaryData = True", "HeaderSize = -2"), HasSubstr("HeaderSize"));
  EXPECT_THAT(with("BinaryData = True", "ElementNumberOfChannels = 3"),
              HasSubstr("ElementNumberOfChannels: '3'"));
}

TEST(MetaImage, PackedBytesTooFewForWhatIsClaimedAreRefusedBeforeMemoryIsTaken) {
  MadeMetaImage made;
  made.size = "60000 60000 60000";
  made.more = "CompressedData = True\n";
  EXPECT_THAT(problem(read_meta_image, made.local(deflated(two_label_pixels))),
              HasSubstr("cannot hold so many"));
}

TEST(MetaImage, IsRefusedCutOffAnywhere) {
  MadeMetaImage made;
  made.more = "CompressedData = True\n";
  testing::expect_no_cut_hurts(read_meta_image, made.local(deflated(two_label_pixels)));
  testing::expect_no_cut_hurts(read_meta_image, MadeMetaImage().local(two_label_pixels));
  const std::string good = MadeMetaImage().local(two_label_pixels);
  EXPECT_NE(problem(read_meta_image, good.substr(0, good.size() - 1)), "nothing");
}

}  // namespace
}  // namespace loft::io
