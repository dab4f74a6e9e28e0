// SPDX-License-Identifier: MIT
#include "io/volumes/nifti.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "tests/io/bytes/gzipped.h"
#include "tests/io/stacks/readers.h"

namespace loft::io {
namespace {

using testing::append;
using testing::gzipped;
using ::testing::HasSubstr;
using testing::problem;
using testing::read;

constexpr std::int16_t u8 = 2;
constexpr std::int16_t i16 = 4;
constexpr std::int16_t f32 = 16;

/// A volume of 4 x 3 pixels in 2 slices; those that are not 0 lie in columns 1 and 2, row 1.
struct MadeNifti {
  bool is_second = false;
  std::endian order = std::endian::little;
  std::vector<std::int64_t> dim{3, 4, 3, 2};
  std::int16_t datatype = u8;
  std::vector<double> pixdim{1, 2, 3, 5};
  double slope = 0;
  double intercept = 0;
  int units = 2;
  int qform = 0;
  int sform = 0;
  std::array<double, 6> quatern{};  ///< and the offset
  std::array<double, 12> srow{};
  std::string magic{};     ///< empty: the version's
  std::string xml{};       ///< in an extension of code 0
  double label = 1;        ///< of pixels that have one
  std::size_t layers = 1;  ///< that pixels are written for

  [[nodiscard]] std::string bytes() const { return is_second ? second() : first(); }

 private:
  template <class Number>
  void at(std::string& header, std::size_t place, Number number) const {
    std::string text;
    append(text, number, order);
    header.replace(place, text.size(), text);
  }

  [[nodiscard]] std::string first() const {
    std::string header(348, '\0');
    at(header, 0, std::int32_t{348});
    for (std::size_t i = 0; i < dim.size(); ++i)
      at(header, 40 + 2 * i, static_cast<std::int16_t>(dim[i]));
    at(header, 70, datatype);
    for (std::size_t i = 0; i < pixdim.size(); ++i)
      at(header, 76 + 4 * i, static_cast<float>(pixdim[i]));
    at(header, 108, static_cast<float>(348 + extension().size()));
    at(header, 112, static_cast<float>(slope));
    at(header, 116, static_cast<float>(intercept));
    header[123] = static_cast<char>(units);
    at(header, 252, static_cast<std::int16_t>(qform));
    at(header, 254, static_cast<std::int16_t>(sform));
    for (std::size_t i = 0; i < 6; ++i) at(header, 256 + 4 * i, static_cast<float>(quatern[i]));
    for (std::size_t i = 0; i < 12; ++i) at(header, 280 + 4 * i, static_cast<float>(srow[i]));
    header.replace(344, 3, magic.empty() ? "n+1" : magic);
    return header + extension() + pixels();
  }

  [[nodiscard]] std::string second() const {
    std::string header(540, '\0');
    at(header, 0, std::int32_t{540});
    header.replace(4, 8, (magic.empty() ? "n+2" : magic) + std::string("\0\r\n\x1a\n", 5));
    at(header, 12, datatype);
    for (std::size_t i = 0; i < dim.size(); ++i) at(header, 16 + 8 * i, dim[i]);
    for (std::size_t i = 0; i < pixdim.size(); ++i) at(header, 104 + 8 * i, pixdim[i]);
    at(header, 168, static_cast<std::int64_t>(540 + extension().size()));
    at(header, 176, slope);
    at(header, 184, intercept);
    at(header, 344, std::int32_t{qform});
    at(header, 348, std::int32_t{sform});
    for (std::size_t i = 0; i < 6; ++i) at(header, 352 + 8 * i, quatern[i]);
    for (std::size_t i = 0; i < 12; ++i) at(header, 400 + 8 * i, srow[i]);
    at(header, 500, std::int32_t{units});
    return header + extension() + pixels();
  }

  [[nodiscard]] std::string extension() const {
    if (xml.empty()) return std::string(4, '\0');
    std::string text("\1\0\0\0", 4);
    append(text, static_cast<std::int32_t>(8 + xml.size()), order);
    append(text, std::int32_t{0}, order);
    return text + xml;
  }

  [[nodiscard]] std::string pixels() const {
    std::string text;
    for (std::size_t slice = 0; slice < 2 * layers; ++slice) {
      for (int i = 0; i < 12; ++i) {
        const double value = i == 5 || i == 6 ? label : 0;
        if (datatype == u8) append(text, static_cast<std::uint8_t>(value), order);
        if (datatype == i16) append(text, static_cast<std::int16_t>(value), order);
        if (datatype == f32) append(text, static_cast<float>(value), order);
      }
    }
    return text;
  }
};

struct Box {
  double left = HUGE_VAL;
  double right = -HUGE_VAL;
  double bottom = HUGE_VAL;
  double top = -HUGE_VAL;
};

Box box_of(const Slice& slice) {
  Box box;
  for (const Contour& contour : slice.contours) {
    for (const cdt::Point& point : contour.points) {
      box.left = std::min(box.left, point.x);
      box.right = std::max(box.right, point.x);
      box.bottom = std::min(box.bottom, point.y);
      box.top = std::max(box.top, point.y);
    }
  }
  return box;
}

/// With edges for outlines pixels reach half a pixel around their centres.
Stack read_edges(const MadeNifti& made) {
  ReadOptions options;
  options.outline = Outline::edges;
  return read(read_nifti, made.bytes(), options);
}

void expect_box(const Slice& slice, double left, double right, double bottom, double top) {
  const Box box = box_of(slice);
  EXPECT_NEAR(box.left, left, 1e-5);
  EXPECT_NEAR(box.right, right, 1e-5);
  EXPECT_NEAR(box.bottom, bottom, 1e-5);
  EXPECT_NEAR(box.top, top, 1e-5);
}

/// Centres of columns 1 and 2 at x 2 and 4, that of row 1 at y 3: what pixdim alone says.
void expect_as_pixdim_says(const Stack& stack) {
  ASSERT_EQ(stack.slices.size(), 2U);
  EXPECT_FALSE(stack.frame);
  EXPECT_EQ(stack.slices[0].z, 0);
  EXPECT_EQ(stack.slices[1].z, 5);
  for (const Slice& slice : stack.slices) {
    ASSERT_EQ(slice.contours.size(), 1U);
    expect_box(slice, 1, 5, 1.5, 4.5);
  }
}

TEST(Nifti, WithoutFormsPixelsLieByTheirDistancesAlone) {
  const Stack stack = read_edges({});
  expect_as_pixdim_says(stack);
  EXPECT_EQ(stack.unit, "mm");
  ASSERT_EQ(stack.labels.size(), 1U);
  EXPECT_EQ(stack.labels[0].name, "1");
  EXPECT_EQ(stack.fill, Fill::even_odd);
}

TEST(Nifti, AnSformWithACodeCountsBeforeAQform) {
  MadeNifti made;
  made.qform = 1;
  made.quatern = {0, 0, 0, 100, 200, 300};
  made.sform = 2;
  made.srow = {4, 0, 0, 10, 0, 6, 0, 20, 0, 0, 8, 30};
  const Stack stack = read_edges(made);
  EXPECT_EQ(stack.slices[0].z, 30);
  EXPECT_EQ(stack.slices[1].z, 38);
  expect_box(stack.slices[0], 12, 20, 23, 29);
}

TEST(Nifti, AnSformOfCodeZeroDoesNotCount) {
  MadeNifti made;
  made.srow = {4, 0, 0, 10, 0, 6, 0, 20, 0, 0, 8, 30};
  expect_as_pixdim_says(read_edges(made));
  made.qform = 1;
  made.quatern = {0, 0, 0, 100, 200, 300};
  const Stack stack = read_edges(made);
  EXPECT_EQ(stack.slices[1].z, 305);
  expect_box(stack.slices[0], 101, 105, 201.5, 204.5);
}

TEST(Nifti, AQformTurnsAndItsSignMirrorsSlices) {
  MadeNifti made;
  made.qform = 1;
  made.quatern = {0, 0, 1, 0, 0, 0};  // half a turn about z
  made.pixdim[0] = -1;
  const Stack stack = read_edges(made);
  EXPECT_EQ(stack.slices[0].z, 0);
  EXPECT_EQ(stack.slices[1].z, -5);
  expect_box(stack.slices[0], -5, -1, -4.5, -1.5);
}

TEST(Nifti, MirroredAxesStayWhereTheyAre) {
  MadeNifti made;
  made.sform = 1;
  made.srow = {-2, 0, 0, 0, 0, 3, 0, 0, 0, 0, 5, 0};
  const Stack stack = read_edges(made);
  EXPECT_FALSE(stack.frame);
  expect_box(stack.slices[0], -5, -1, 1.5, 4.5);
}

TEST(Nifti, ObliqueSlicesHaveAFrameThatGivesTheWorldBack) {
  MadeNifti made;
  made.sform = 1;
  const float c = 0.8F;
  const float s = 0.6F;
  made.srow = {2, 0, 0, 7, 0, 3 * c, -5 * s, 8, 0, 3 * s, 5 * c, 9};
  const Stack stack = read_edges(made);
  ASSERT_TRUE(stack.frame);
  EXPECT_TRUE(fault(*stack.frame).empty());
  const Slice& slice = stack.slices[1];
  const Box box = box_of(slice);
  // The middle of the pixels is at column 1.5, row 1, slice 1.
  const Vec3 place =
      stack.frame->at({(box.left + box.right) / 2, (box.bottom + box.top) / 2, slice.z});
  EXPECT_NEAR(place[0], 2 * 1.5 + 7, 1e-5);
  EXPECT_NEAR(place[1], 3 * 0.8 - 5 * 0.6 + 8, 1e-5);
  EXPECT_NEAR(place[2], 3 * 0.6 + 5 * 0.8 + 9, 1e-5);
}

TEST(Nifti, AFrameHasNoNumberThatOnlyRoundingLeft) {
  MadeNifti made;
  made.is_second = true;
  made.sform = 1;
  // The product of the two small ones is too small for a frame.
  made.srow = {2, 0, 0, 0, 0, 1e-28, -5, 0, 3e-32, 3, 0, 0};
  const Stack stack = read_edges(made);
  ASSERT_TRUE(stack.frame);
  EXPECT_EQ(fault(*stack.frame), "");
}

TEST(Nifti, ASlopeOfZeroOrNoNumberIsNone) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double slope : {0.0, nan, HUGE_VAL}) {
    MadeNifti made;
    made.slope = slope;
    made.intercept = 17;
    made.label = 3;
    EXPECT_EQ(read_edges(made).labels.at(0).name, "3") << slope;
  }
}

TEST(Nifti, ASlopeMakesLabelsOfWhatIsWritten) {
  MadeNifti made;
  made.slope = 2;
  made.intercept = std::numeric_limits<double>::quiet_NaN();
  made.label = 3;
  EXPECT_EQ(read_edges(made).labels.at(0).name, "6");
}

TEST(Nifti, LabelsMayBeWrittenAsFloats) {
  MadeNifti made;
  made.datatype = f32;
  made.label = 4;
  EXPECT_EQ(read_edges(made).labels.at(0).name, "4");
  made.label = 4.25;
  EXPECT_THAT(problem(read_nifti, made.bytes()), HasSubstr("pixel of value 4.25"));
}

TEST(Nifti, FloatsBetweenZeroAndOneAreShares) {
  MadeNifti made;
  made.datatype = f32;
  made.label = 0.75;
  EXPECT_EQ(read(read_nifti, made.bytes()).slices.at(0).contours.size(), 1U);
  made.label = 0.25;
  EXPECT_THROW(static_cast<void>(read(read_nifti, made.bytes())), InputError);
}

TEST(Nifti, AFourthDimensionOfOneVolumeChangesNothing) {
  MadeNifti made;
  made.dim = {4, 4, 3, 2, 1};
  expect_as_pixdim_says(read_edges(made));
}

TEST(Nifti, SeveralVolumesAreLayersThatMayOverlap) {
  MadeNifti made;
  made.dim = {4, 4, 3, 2, 2};
  made.layers = 2;
  const Stack stack = read_edges(made);
  EXPECT_EQ(stack.labels.size(), 2U);
  EXPECT_EQ(stack.slices[0].contours.size(), 2U);
}

TEST(Nifti, EitherVersionIsReadInEitherOrderOfBytes) {
  for (const bool is_second : {false, true}) {
    for (const std::endian order : {std::endian::little, std::endian::big}) {
      for (const std::int16_t datatype : {u8, i16, f32}) {
        MadeNifti made;
        made.is_second = is_second;
        made.order = order;
        made.datatype = datatype;
        EXPECT_TRUE(begins_like_nifti(made.bytes()));
        expect_as_pixdim_says(read_edges(made));
      }
    }
  }
}

TEST(Nifti, GzipIsReadInOneMemberOrSeveral) {
  const MadeNifti made;
  const Stack plain = read(read_nifti, made.bytes());
  for (const std::size_t members : {1U, 2U, 5U}) {
    const std::string packed = gzipped(made.bytes(), members);
    EXPECT_TRUE(begins_like_nifti(packed));
    EXPECT_EQ(read(read_nifti, packed), plain) << members;
  }
}

TEST(Nifti, ATableInTheHeadersExtensionNamesAndColoursLabels) {
  MadeNifti made;
  made.label = 7;
  made.xml =
      "<?xml version=\"1.0\"?><CaretExtension><LabelTable>"
      "<Label Key=\"0\" Red=\"0\" Green=\"0\" Blue=\"0\"><![CDATA[???]]></Label>"
      "<Label Key=\"7\" Red=\"1\" Green=\"0.501961\" Blue=\"0\"><![CDATA[left lung]]></Label>"
      "<Label Key=\"8\" Red=\"1\" Green=\"0\" Blue=\"0\">a &amp; b</Label>"
      "</LabelTable></CaretExtension>";
  for (const bool is_second : {false, true}) {
    made.is_second = is_second;
    const Stack stack = read_edges(made);
    ASSERT_EQ(stack.labels.size(), 1U);
    EXPECT_EQ(stack.labels[0].name, "left lung");
    EXPECT_EQ(stack.labels[0].id, "7");
    EXPECT_EQ(stack.labels[0].colour, (Colour{255, 128, 0}));
    EXPECT_EQ(stack.slices[0].contours.at(0).label, "left lung");
    EXPECT_THAT(stack.notes, ::testing::Contains(HasSubstr("without a pixel, left out: a & b")));
  }
}

TEST(Nifti, TruncatedAtAnyByteItIsRefused) {
  for (const bool is_second : {false, true}) {
    MadeNifti made;
    made.is_second = is_second;
    const std::string bytes = made.bytes();
    for (const std::string& file : {bytes, gzipped(bytes)}) {
      testing::expect_no_cut_hurts(read_nifti, file);
      EXPECT_THAT(problem(read_nifti, file.substr(0, file.size() - 12)), HasSubstr("a.file: "));
    }
  }
}

TEST(Nifti, SizesBeyondTheFileAreRefusedBeforeMemoryIsTaken) {
  MadeNifti made;
  made.dim = {3, 32767, 8191, 32767};
  EXPECT_THAT(problem(read_nifti, made.bytes()), HasSubstr("cut off"));
  EXPECT_THAT(problem(read_nifti, gzipped(made.bytes())), HasSubstr("a.file"));
  made.dim = {7, 32767, 32767, 32767, 32767, 32767, 32767, 32767};
  EXPECT_THAT(problem(read_nifti, made.bytes()), HasSubstr("dim[6] is 32767"));
  made.is_second = true;
  made.dim = {3, std::int64_t{1} << 31, 1, 1};
  EXPECT_THAT(problem(read_nifti, made.bytes()), HasSubstr("cut off"));
  made.dim = {3, std::int64_t{1} << 62, 1, 1};
  EXPECT_THAT(problem(read_nifti, made.bytes()), HasSubstr("byte 16: dim[1]"));
}

TEST(Nifti, SizesThatAreNoneAreNamed) {
  MadeNifti made;
  made.dim = {3, 4, 0, 2};
  EXPECT_THAT(problem(read_nifti, made.bytes()), HasSubstr("byte 40: dim[2] is 0"));
  made.dim = {3, 4, -3, 2};
  EXPECT_THAT(problem(read_nifti, made.bytes()), HasSubstr("byte 40: dim[2] is -3"));
  made.dim = {8, 4, 3, 2};
  EXPECT_THAT(problem(read_nifti, made.bytes()), HasSubstr("dim[0] is 8"));
}

TEST(Nifti, ADistanceOfZeroAsksForTheSpacing) {
  MadeNifti made;
  made.pixdim = {1, 2, 3, 0};
  EXPECT_THAT(problem(read_nifti, made.bytes()), HasSubstr("--spacing x,y,z"));
  ReadOptions options;
  options.spacing = Vec3{2, 3, 5};
  options.outline = Outline::edges;
  expect_as_pixdim_says(read(read_nifti, made.bytes(), options));
}

TEST(Nifti, MatricesThatCannotBeUsedAreRefused) {
  MadeNifti made;
  made.sform = 1;
  made.srow = {2, 2, 0, 0, 3, 3, 0, 0, 0, 0, 5, 0};
  EXPECT_THAT(problem(read_nifti, made.bytes()), HasSubstr("is singular"));
  made.srow = {2, 0, 0, 0, 0, std::numeric_limits<double>::quiet_NaN(), 0, 0, 0, 0, 5, 0};
  EXPECT_THAT(problem(read_nifti, made.bytes()), HasSubstr("a number that is none"));
}

TEST(Nifti, AnotherMagicOrKindOfNumberIsNamedWithItsPlace) {
  MadeNifti made;
  made.magic = "abc";
  EXPECT_FALSE(begins_like_nifti(made.bytes()));
  EXPECT_THAT(problem(read_nifti, made.bytes()), HasSubstr("byte 344: the magic"));
  made.magic = "";
  made.datatype = 128;
  EXPECT_THAT(problem(read_nifti, made.bytes()), HasSubstr("byte 70: datatype 128"));
}

TEST(Nifti, APairWithoutItsPixelsSaysWhichFileIsMissing) {
  MadeNifti made;
  made.magic = "ni1";
  EXPECT_THAT(problem(read_nifti, made.bytes()), HasSubstr(".img, which is not there"));
}

}  // namespace
}  // namespace loft::io
