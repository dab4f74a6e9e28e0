// SPDX-License-Identifier: MIT
#include <dcmtk/config/osconfig.h>
//
#include <dcmtk/dcmdata/dcpixel.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "io/dicom/cielab.h"
#include "io/dicom/dicom.h"
#include "mesh/check.h"
#include "reconstruct/reconstruct.h"
#include "tests/io/dicom/made_dicom.h"
#include "tests/io/stacks/readers.h"
#include "tests/io/volumes/masks.h"

namespace loft::io {
namespace {

using testing::add_item;
using testing::bytes_of;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::problem;
using testing::put;
using testing::read;

constexpr const char* segmentation = "1.2.840.10008.5.1.4.1.1.66.4";
constexpr const char* label_map = "1.2.840.10008.5.1.4.1.1.66.7";
constexpr std::uint16_t columns = 5;
constexpr std::uint16_t rows = 3;

struct MadeFrame {
  double z = 0;
  std::uint16_t segment = 1;
  std::vector<int> pixels;  ///< columns * rows
  double x = 0;
};

struct MadeSegment {
  std::uint16_t number = 1;
  std::string name = "organ";
  std::vector<std::uint16_t> colour{};
};

struct MadeSeg {
  std::string sop_class = segmentation;
  std::string type = "BINARY";
  std::uint16_t bits = 1;
  std::vector<MadeSegment> segments{{}};
  std::vector<MadeFrame> frames{};
  std::string orientation = "1\\0\\0\\0\\1\\0";
  std::string pixel_spacing = "3\\2";  ///< of rows and of columns
  std::string spacing = "4";           ///< of planes; empty: none
  std::string thickness = "4";
  std::string frame_count{};  ///< empty: as many as there are
  std::size_t pixel_bytes_missing = 0;
  std::uint16_t largest = 255;
};

void put(DcmItem& item, const DcmTagKey& tag, std::uint16_t number) {
  static_cast<void>(item.putAndInsertUint16(tag, number));
}

void put_segments(DcmDataset& set, const MadeSeg& made) {
  for (const MadeSegment& segment : made.segments) {
    DcmItem& item = add_item(set, DCM_SegmentSequence);
    put(item, DCM_SegmentNumber, segment.number);
    put(item, DCM_SegmentLabel, segment.name);
    put(add_item(item, DCM_SegmentedPropertyCategoryCodeSequence), DCM_CodeMeaning, "Tissue");
    if (!segment.colour.empty())
      static_cast<void>(item.putAndInsertUint16Array(DCM_RecommendedDisplayCIELabValue,
                                                     segment.colour.data(), 3));
  }
}

void put_places(DcmDataset& set, const MadeSeg& made) {
  DcmItem& shared = add_item(set, DCM_SharedFunctionalGroupsSequence);
  put(add_item(shared, DCM_PlaneOrientationSequence), DCM_ImageOrientationPatient,
      made.orientation);
  DcmItem& measures = add_item(shared, DCM_PixelMeasuresSequence);
  put(measures, DCM_PixelSpacing, made.pixel_spacing);
  if (!made.spacing.empty()) put(measures, DCM_SpacingBetweenSlices, made.spacing);
  if (!made.thickness.empty()) put(measures, DCM_SliceThickness, made.thickness);
  for (const MadeFrame& frame : made.frames) {
    DcmItem& item = add_item(set, DCM_PerFrameFunctionalGroupsSequence);
    put(add_item(item, DCM_PlanePositionSequence), DCM_ImagePositionPatient,
        testing::decimals({{frame.x, 0, frame.z}}));
    if (made.sop_class == segmentation)
      put(add_item(item, DCM_SegmentIdentificationSequence), DCM_ReferencedSegmentNumber,
          frame.segment);
  }
}

void put_pixels(DcmDataset& set, const MadeSeg& made) {
  std::vector<Uint8> bytes;
  std::size_t bit = 0;
  for (const MadeFrame& frame : made.frames) {
    for (const int pixel : frame.pixels) {
      bytes.resize(bit / 8 + std::max<std::size_t>(1, made.bits / 8U));
      if (made.bits == 1)
        bytes[bit / 8] = static_cast<Uint8>(bytes[bit / 8] | pixel << (bit % 8));
      else
        for (std::size_t i = 0; i < made.bits / 8U; ++i)
          bytes[bit / 8 + i] = static_cast<Uint8>(pixel >> (8 * i));
      bit += made.bits;
    }
  }
  bytes.resize(bytes.size() - std::min(bytes.size(), made.pixel_bytes_missing));
  if (bytes.size() % 2 != 0) bytes.push_back(0);
  if (made.bits == 16) {
    std::vector<Uint16> words;
    for (std::size_t i = 0; i < bytes.size(); i += 2)
      words.push_back(static_cast<Uint16>(bytes[i] | bytes[i + 1] << 8));
    static_cast<void>(set.putAndInsertUint16Array(DCM_PixelData, words.data(), words.size()));
  } else {
    static_cast<void>(set.putAndInsertUint8Array(DCM_PixelData, bytes.data(), bytes.size()));
  }
}

std::string file_of(const MadeSeg& made, E_TransferSyntax syntax = EXS_LittleEndianExplicit) {
  DcmDataset set;
  put(set, DCM_SOPClassUID, made.sop_class);
  put(set, DCM_SOPInstanceUID, "1.2.3.4");
  put(set, DCM_Modality, "SEG");
  put(set, DCM_SamplesPerPixel, 1);
  put(set, DCM_NumberOfFrames,
      made.frame_count.empty() ? std::to_string(made.frames.size()) : made.frame_count);
  put(set, DCM_Rows, rows);
  put(set, DCM_Columns, columns);
  put(set, DCM_BitsAllocated, made.bits);
  put(set, DCM_BitsStored, made.bits);
  put(set, DCM_PixelRepresentation, 0);
  put(set, DCM_SegmentationType, made.type);
  if (made.type == "FRACTIONAL") put(set, DCM_MaximumFractionalValue, made.largest);
  put_segments(set, made);
  put_places(set, made);
  put_pixels(set, made);
  return bytes_of(set, syntax);
}

Stack read(const MadeSeg& made) { return read(file_of(made)); }
std::string problem(const MadeSeg& made) { return problem(file_of(made)); }

/// Whole columns of pixels of a value.
std::vector<int> bars(std::vector<std::size_t> at, int value = 1) {
  std::vector<int> pixels(columns * rows);
  for (const std::size_t column : at)
    for (std::size_t row = 0; row < rows; ++row) pixels[row * columns + column] = value;
  return pixels;
}

/// Each pixel's centre is inside of a label where the mask has it, and nowhere else.
void expect_mask(const Slice& slice, const std::string& label, const std::vector<int>& mask,
                 double x = 0) {
  for (std::size_t i = 0; i < mask.size(); ++i) {
    const cdt::Point centre{x + 2.0 * static_cast<double>(i % columns),
                            3.0 * static_cast<double>(i / columns)};
    EXPECT_EQ(testing::encloses(slice, label, centre), mask[i] != 0) << label << ' ' << i;
  }
}

std::vector<double> heights_of(const Stack& stack) {
  std::vector<double> all;
  for (const Slice& slice : stack.slices) all.push_back(slice.z);
  return all;
}

MadeSeg three_frames() {
  MadeSeg made;
  made.frames = {{8, 1, bars({1, 2})}, {0, 1, bars({3})}, {4, 1, bars({0, 2, 4})}};
  return made;
}

TEST(Seg, BitsRunAcrossFramesWhoseOrderIsThatOfTheirPlaces) {
  static_assert(columns * rows % 8 != 0);
  for (const E_TransferSyntax syntax : {EXS_LittleEndianExplicit, EXS_LittleEndianImplicit,
                                        EXS_BigEndianExplicit, EXS_DeflatedLittleEndianExplicit}) {
    const Stack stack = read(file_of(three_frames(), syntax));
    ASSERT_THAT(heights_of(stack), ElementsAre(0, 4, 8));
    expect_mask(stack.slices[0], "organ", bars({3}));
    expect_mask(stack.slices[1], "organ", bars({0, 2, 4}));
    expect_mask(stack.slices[2], "organ", bars({1, 2}));
    EXPECT_EQ(stack.unit, "mm");
    EXPECT_EQ(stack.gap, 4);
  }
}

TEST(Seg, ABinaryOneOfABytePerPixelIsRead) {
  MadeSeg made = three_frames();
  made.bits = 8;
  EXPECT_EQ(read(made), read(three_frames()));
}

TEST(Seg, AFrameThatIsLeftOutIsAnEmptySlice) {
  MadeSeg made;
  made.frames = {{0, 1, bars({1})}, {4, 1, bars({1})}, {12, 1, bars({1})}};
  const Stack stack = read(made);
  ASSERT_THAT(heights_of(stack), ElementsAre(0, 4, 8, 12));
  EXPECT_TRUE(stack.slices[2].contours.empty());
}

TEST(Seg, AWideGapIsLeftOpenByASliceAtEitherEnd) {
  MadeSeg made;
  made.frames = {{0, 1, bars({1})}, {4e6, 1, bars({1})}};
  EXPECT_THAT(heights_of(read(made)), ElementsAre(0, 4, 4e6 - 4, 4e6));
}

TEST(Seg, DistancesThatAreNoMultiplesAreKept) {
  MadeSeg made;
  made.frames = {{0, 1, bars({1})}, {5, 1, bars({1})}, {11.5, 1, bars({1})}};
  EXPECT_THAT(heights_of(read(made)), ElementsAre(0, 5, 11.5));
}

TEST(Seg, AThicknessIsADistanceOnlyWhereSomePlanesAreSoFarApart) {
  MadeSeg made;
  made.spacing = "";
  made.thickness = "2";
  made.frames = {{0, 1, bars({1})}, {4, 1, bars({1})}, {8, 1, bars({1})}};
  EXPECT_THAT(heights_of(read(made)), ElementsAre(0, 4, 8));
  made.frames.push_back({10, 1, bars({1})});
  EXPECT_THAT(heights_of(read(made)), ElementsAre(0, 2, 4, 6, 8, 10));
}

TEST(Seg, SegmentsMayOverlapAndHaveNamesColoursAndCategories) {
  MadeSeg made;
  made.segments = {{2, "vessel", {65535, 32896, 32896}}, {1, "organ"}, {7, "absent"}};
  made.frames = {{4, 2, bars({2, 3})}, {0, 1, bars({1, 2})}, {4, 1, bars({1, 2})}};
  const Stack stack = read(made);
  ASSERT_THAT(heights_of(stack), ElementsAre(0, 4));
  expect_mask(stack.slices[0], "vessel", bars({}));
  expect_mask(stack.slices[1], "organ", bars({1, 2}));
  expect_mask(stack.slices[1], "vessel", bars({2, 3}));
  ASSERT_EQ(stack.labels.size(), 2U);
  EXPECT_EQ(stack.labels[0], (StackLabel{"organ", {}, "1", "Tissue"}));
  EXPECT_EQ(stack.labels[1], (StackLabel{"vessel", Colour{255, 255, 255}, "2", "Tissue"}));
  EXPECT_THAT(stack.notes, Contains(HasSubstr("segments without a frame, left out: absent")));
}

TEST(Seg, ColoursAreThoseThatDcmqiMeant) {
  EXPECT_EQ(from_cielab({0, 32896, 32896}), (Colour{0, 0, 0}));
  EXPECT_EQ(from_cielab({65535, 32896, 32896}), (Colour{255, 255, 255}));
  EXPECT_EQ(from_cielab({41661, 41167, 40792}), (Colour{221, 130, 101}));  // its liver
}

TEST(Seg, OfShareHalfOfTheLargestPossibleIsInside) {
  MadeSeg made;
  made.type = "FRACTIONAL";
  made.bits = 8;
  made.frames = {{0, 1, bars({1}, 128)}, {4, 1, bars({2}, 127)}};
  const Stack stack = read(made);
  expect_mask(stack.slices[0], "organ", bars({1}));
  EXPECT_TRUE(stack.slices[1].contours.empty());
  made.largest = 100;
  expect_mask(read(made).slices[1], "organ", bars({2}));
  made.largest = 0;
  EXPECT_THAT(problem(made), HasSubstr("(0062,000e): the largest value is 0"));
}

TEST(Seg, ALabelMapHasABackgroundThatIsNone) {
  for (const std::uint16_t bits : {std::uint16_t{8}, std::uint16_t{16}}) {
    const int second = bits == 8 ? 200 : 700;
    MadeSeg made;
    made.sop_class = label_map;
    made.type = "LABELMAP";
    made.bits = bits;
    made.segments = {{0, "Background"}, {1, "organ"}, {static_cast<std::uint16_t>(second), "bone"}};
    std::vector<int> pixels = bars({1});
    for (std::size_t row = 0; row < rows; ++row) pixels[row * columns + 3] = second;
    made.frames = {{4, 0, pixels}, {0, 0, bars({2})}};
    const Stack stack = read(made);
    ASSERT_THAT(heights_of(stack), ElementsAre(0, 4));
    expect_mask(stack.slices[0], "organ", bars({2}));
    expect_mask(stack.slices[1], "organ", bars({1}));
    expect_mask(stack.slices[1], "bone", bars({3}));
    EXPECT_EQ(stack.labels.size(), 2U);
  }
}

TEST(Seg, TiltedPlanesHaveAFrame) {
  MadeSeg made = three_frames();
  made.orientation = "1\\0\\0\\0\\0.8\\0.6";
  const Stack stack = read(made);
  ASSERT_TRUE(stack.frame);
  EXPECT_TRUE(fault(*stack.frame).empty());
  // Places differ along z, of which 0.8 is along the normal.
  EXPECT_NEAR(stack.slices[1].z - stack.slices[0].z, 0.8 * 4, 1e-12);
}

TEST(Seg, ItsSurfaceIsClosed) {
  const Surface surface = reconstruct(read(three_frames())).surface;
  EXPECT_TRUE(check(surface).empty());
}

TEST(Seg, FramesAsideOfTheOthersAreRefused) {
  MadeSeg made = three_frames();
  made.frames[2].x = 1;
  EXPECT_THAT(problem(made), HasSubstr("(5200,9230)[2]/(0020,9113)/(0020,0032): lies 1 mm aside"));
}

TEST(Seg, TwoFramesOfASegmentInAPlaneAreRefused) {
  MadeSeg made = three_frames();
  made.frames[2].z = 0;
  EXPECT_THAT(problem(made), HasSubstr("(5200,9230)[2]: is in the plane of frame 1"));
}

TEST(Seg, SizesAreCheckedAgainstTheBytesThatAreThere) {
  MadeSeg made = three_frames();
  made.pixel_bytes_missing = 2;
  EXPECT_THAT(problem(made), HasSubstr("(7fe0,0010): has 4 bytes where 3 frames need 6"));
  made = three_frames();
  made.frame_count = "2147483647";
  EXPECT_THAT(problem(made), HasSubstr("(0028,0008): frames are said to be 2147483647"));
}

TEST(Seg, PlacesAndDistancesThatAreNoneAreAllNamed) {
  MadeSeg made = three_frames();
  made.orientation = "1\\0\\0\\1\\0\\0";
  made.pixel_spacing = "0\\2";
  const std::string words = problem(made);
  EXPECT_THAT(words, HasSubstr("made.dcm: (5200,9230)[0]/(0028,9110)/(0028,0030): is no two"));
  EXPECT_THAT(words, HasSubstr("made.dcm: (5200,9230)[2]/(0020,9116)/(0020,0037): has no two"));
}

TEST(Seg, ATypeOrBitsThatAreNoneAreNamed) {
  MadeSeg made = three_frames();
  made.type = "SURFACE";
  EXPECT_THAT(problem(made), HasSubstr("(0062,0001): the type of segmentation 'SURFACE'"));
  made = three_frames();
  made.type = "FRACTIONAL";
  EXPECT_THAT(problem(made), HasSubstr("(0028,0100): 1 bits a pixel"));
}

constexpr const char* rle_lossless = "1.2.840.10008.1.2.5";

/// With the transfer syntax of its meta information replaced by another.
std::string with_syntax(std::string bytes, std::string uid) {
  const std::string old = "1.2.840.10008.1.2.1";
  if (uid.size() % 2 != 0) uid += '\0';
  const std::size_t at = bytes.find(old);
  bytes[at - 2] = static_cast<char>(uid.size());
  bytes.replace(at, 20, uid);
  bytes[140] = static_cast<char>(bytes[140] + static_cast<char>(uid.size()) - 20);
  return bytes;
}

/// Its pixels as fragments of even sizes, behind a table that is empty.
std::string with_fragments(std::string bytes, const std::vector<std::string>& fragments) {
  const std::string tag("\xe0\x7f\x10\x00", 4);
  bytes.resize(bytes.rfind(tag));
  bytes +=
      tag + std::string("OB\0\0\xff\xff\xff\xff", 8) + std::string("\xfe\xff\x00\xe0\0\0\0\0", 8);
  for (const std::string& fragment : fragments) {
    bytes += std::string("\xfe\xff\x00\xe0", 4);
    testing::append(bytes, static_cast<std::uint32_t>(fragment.size()), std::endian::little);
    bytes += fragment;
  }
  return bytes + std::string("\xfe\xff\xdd\xe0\0\0\0\0", 8);
}

TEST(Seg, CompressedPixelsAreRefusedByName) {
  const auto with = [](const char* uid) {
    return problem(with_fragments(with_syntax(file_of(three_frames()), uid), {"abcd"}));
  };
  EXPECT_THAT(with("1.2.840.10008.1.2.4.90"),
              HasSubstr("(7fe0,0010): pixels are compressed by JPEG 2000"));
  EXPECT_THAT(with("1.2.840.10008.1.2.8.1"),
              HasSubstr("Deflated Image Frame Compression (1.2.840.10008.1.2.8.1)"));
}

/// Runs of what is the same, and of what is not.
std::string packed_runs(const std::string& bytes) {
  std::string packed;
  for (std::size_t at = 0; at < bytes.size();) {
    const std::size_t end = std::min(bytes.find_first_not_of(bytes[at], at), bytes.size());
    const std::size_t count = std::min<std::size_t>(end - at, 128);
    if (count > 1) {
      packed += static_cast<char>(257 - count);
    } else {
      packed += std::string("\x80\0", 2);  // one that means nothing, and a run of one
    }
    packed += bytes[at];
    at += count;
  }
  if (packed.size() % 2 != 0) packed += '\0';
  return packed;
}

/// A frame by RLE Lossless.
std::string packed_frame(const std::vector<std::string>& segments) {
  std::string head;
  testing::append(head, static_cast<std::uint32_t>(segments.size()), std::endian::little);
  std::string runs;
  for (const std::string& segment : segments) {
    testing::append(head, static_cast<std::uint32_t>(64 + runs.size()), std::endian::little);
    runs += packed_runs(segment);
  }
  head.resize(64);
  return head + runs;
}

/// The same by RLE Lossless, frame by frame.
std::string packed(const MadeSeg& made) {
  std::vector<std::string> fragments;
  for (const MadeFrame& frame : made.frames) {
    std::vector<std::string> segments(made.bits == 16 ? 2 : 1);
    std::size_t bit = 0;
    for (const int pixel : frame.pixels) {
      if (made.bits == 16) segments[0] += static_cast<char>(pixel >> 8);
      if (made.bits > 1) {
        segments.back() += static_cast<char>(pixel);
        continue;
      }
      if (bit % 8 == 0) segments[0] += '\0';
      segments[0].back() = static_cast<char>(segments[0].back() | pixel << (bit % 8));
      ++bit;
    }
    fragments.push_back(packed_frame(segments));
  }
  return with_fragments(with_syntax(file_of(made), rle_lossless), fragments);
}

TEST(Seg, ByRleLosslessItIsTheSame) {
  const auto seed = std::random_device{}();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937_64 random(seed);
  for (const std::uint16_t bits : {std::uint16_t{8}, std::uint16_t{16}}) {
    MadeSeg made;
    made.sop_class = label_map;
    made.type = "LABELMAP";
    made.bits = bits;
    const int step = bits == 8 ? 1 : 257;
    std::vector<int> all;
    for (const double z : {0.0, 4.0, 8.0}) {
      std::vector<int> pixels = testing::random_labels(columns * rows, 3, random);
      for (int& pixel : pixels) pixel *= step;
      all.insert(all.end(), pixels.begin(), pixels.end());
      made.frames.push_back({z, 0, pixels});
    }
    made.segments = {};
    const Stack stack = read(packed(made));
    EXPECT_EQ(stack, read(made));
    EXPECT_EQ(testing::differing_pixels(stack, columns, rows, all, testing::number_as_name, 2, 3),
              0U);
  }
}

TEST(Seg, ByRleLosslessFramesOfBitsBeginWithAByteOfTheirOwn) {
  EXPECT_EQ(read(packed(three_frames())), read(three_frames()));
  MadeSeg shares;
  shares.type = "FRACTIONAL";
  shares.bits = 8;
  shares.frames = {{0, 1, bars({1}, 128)}, {4, 1, bars({2, 3}, 200)}};
  EXPECT_EQ(read(packed(shares)), read(shares));
}

TEST(Seg, OfRleLosslessDamageIsNamed) {
  const auto with = [](const std::vector<std::string>& fragments) {
    return problem(with_fragments(with_syntax(file_of(three_frames()), rle_lossless), fragments));
  };
  const std::string good = packed_frame({std::string(2, '\1')});
  EXPECT_EQ(with({good, good, good}), "nothing");
  EXPECT_THAT(with({good, good}), HasSubstr("(7fe0,0010): has 2 fragments for 3 frames"));
  EXPECT_THAT(with({good, good, "abcd"}),
              HasSubstr("(7fe0,0010): fragment 2, byte 0: there is no header of 64 bytes"));
  EXPECT_THAT(with({packed_frame({"ab", "ab"}), good, good}), HasSubstr("has 2 segments"));
  EXPECT_THAT(with({packed_frame({"a"}), good, good}), HasSubstr("the runs end too early"));
  std::string beyond = good;
  beyond[5] = '\1';  // begins at byte 320
  EXPECT_THAT(with({good, beyond, good}), HasSubstr("fragment 1, byte 4: a segment from 320"));
  EXPECT_THAT(with({}), HasSubstr("(7fe0,0010): has 0 fragments for 3 frames"));
  EXPECT_THAT(problem(with_syntax(file_of(three_frames()), rle_lossless)),
              HasSubstr("uses explicit length"));
  const std::string bytes = packed(three_frames());
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_THAT(problem(bytes.substr(0, size)), HasSubstr("made.dcm: ")) << size;
}

TEST(Seg, CutOffAnywhereItIsRefused) {
  const std::string bytes = file_of(three_frames());
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const std::string cut = bytes.substr(0, size);
    EXPECT_THAT(problem(cut), HasSubstr("made.dcm: ")) << size;
  }
}

}  // namespace
}  // namespace loft::io
