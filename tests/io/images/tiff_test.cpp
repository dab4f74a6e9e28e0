// SPDX-License-Identifier: MIT
#include "io/images/tiff.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tiffio.h>

#include <random>
#include <string>
#include <vector>

#include "io/stack.h"
#include "tests/io/images/made_tiff.h"
#include "tests/io/images/spaced.h"
#include "tests/io/volumes/masks.h"

namespace loft::io {
namespace {

using testing::append;
using testing::differing_pixels;
using testing::encloses;
using testing::Folder;
using ::testing::HasSubstr;
using testing::MadePage;
using testing::number_as_name;
using testing::read;
using testing::spaced;
using testing::tiff_of;
using testing::two_label_slice;

Stack read_spaced(std::string_view bytes) { return read(read_tiff, bytes, spaced); }
std::string tiff_problem(std::string_view bytes, const ReadOptions& options = spaced) {
  return testing::problem(read_tiff, bytes, options);
}

/// Pages of 3 x 2 pixels of which (1, 0) is 1 and (2, 1) is 2.
MadePage page() { return {.pixels = two_label_slice}; }
Stack stack_of_pages() { return read_spaced(tiff_of({page(), page()})); }

/// With ImageJ's description of two slices in the first page.
std::vector<MadePage> of_image_j(const std::string& lines, double resolution = 2) {
  std::vector<MadePage> pages{page(), page()};
  pages[0].description = "ImageJ=1.53t\nimages=2\nslices=2\n" + lines;
  pages[0].x_resolution = pages[0].y_resolution = resolution;
  return pages;
}

TEST(Tiff, PagesAreSlicesAndRowsRunAlongY) {
  const Stack stack = stack_of_pages();
  ASSERT_EQ(stack.slices.size(), 2U);
  EXPECT_EQ(stack.slices[1].z - stack.slices[0].z, 5);
  EXPECT_TRUE(encloses(stack.slices[0], "1", {2, 0}));
  EXPECT_TRUE(encloses(stack.slices[1], "2", {4, 3}));
  EXPECT_FALSE(encloses(stack.slices[0], "1", {0, 0}));
  EXPECT_EQ(stack.unit, "");
}

TEST(Tiff, OutlinesEncloseItsPixelsAndNoOthers) {
  const auto seed = std::random_device{}();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937_64 random(seed);
  const std::vector<int> labels = testing::random_labels(std::size_t{9} * 8 * 3, 4, random);
  for (const std::endian order : {std::endian::little, std::endian::big}) {
    std::vector<MadePage> pages(3, {.columns = 9, .rows = 8, .bits = 16});
    for (std::size_t i = 0; i < labels.size(); ++i)
      append(pages[i / 72].pixels, static_cast<std::uint16_t>(labels[i]), order);
    for (const Outline outline : {Outline::iso_lines, Outline::edges}) {
      const Stack stack =
          read(read_tiff, tiff_of(pages, order), {.spacing = Vec3{2, 3, 5}, .outline = outline});
      EXPECT_EQ(differing_pixels(stack, 9, 8, labels, number_as_name, 2, 3), 0U);
    }
  }
}

TEST(Tiff, EveryTypeOfNumberIsRead) {
  const auto expect = [](auto number, std::uint16_t format) {
    for (const std::endian order : {std::endian::little, std::endian::big}) {
      MadePage made{.bits = 8 * sizeof(number), .format = format};
      for (const char label : two_label_slice)
        append(made.pixels, static_cast<decltype(number)>(label), order);
      EXPECT_EQ(read_spaced(tiff_of({made, made}, order)), stack_of_pages())
          << made.bits << ' ' << format;
    }
  };
  expect(std::uint8_t{}, 1);
  expect(std::uint16_t{}, 1);
  expect(std::uint32_t{}, 1);
  expect(std::uint64_t{}, 1);
  expect(std::int8_t{}, 2);
  expect(std::int16_t{}, 2);
  expect(std::int32_t{}, 2);
  expect(std::int64_t{}, 2);
  expect(float{}, 3);
  expect(double{}, 3);
}

TEST(Tiff, PixelsOfLessThanAByteBeginWithItsHighestBits) {
  const MadePage two{.bits = 2, .pixels = {"\x10\x08", 2}};
  EXPECT_EQ(read_spaced(tiff_of({two, two})), stack_of_pages());
  const MadePage four{.bits = 4, .pixels = {"\x01\x00\x00\x20", 4}};
  EXPECT_EQ(read_spaced(tiff_of({four, four})), stack_of_pages());
  const MadePage one{.bits = 1, .pixels = {"\x40\x20", 2}};
  const Stack stack = read_spaced(tiff_of({one, one}));
  EXPECT_TRUE(encloses(stack.slices[0], "1", {2, 0}));
  EXPECT_TRUE(encloses(stack.slices[0], "1", {4, 3}));
}

TEST(Tiff, FloatsFromZeroToOneAreShares) {
  MadePage made{.bits = 32, .format = 3};
  for (const float share : {0.F, 0.75F, 0.F, 0.F, 0.F, 0.25F})
    append(made.pixels, share, std::endian::little);
  EXPECT_EQ(read_spaced(tiff_of({made, made})).slices[0].contours.size(), 1U);
}

struct Packing {
  std::uint16_t compression;
  std::uint16_t predictor = PREDICTOR_NONE;
};

/// By libtiff, 16 bits, in tiles or strips of 16 rows; `labels` of pages of 40 x 35.
std::string written(const std::vector<int>& labels, const Packing& packing, bool is_tiled,
                    const char* mode) {
  const Folder folder;
  const std::string path = (folder / "a.tif").string();
  TIFFSetWarningHandler(nullptr);  // of what is old
  TIFF* const tiff = TIFFOpen(path.c_str(), mode);
  for (std::size_t first = 0; first < labels.size(); first += 1400) {
    TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, 40);
    TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, 35);
    TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, 16);
    TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK);
    TIFFSetField(tiff, TIFFTAG_COMPRESSION, packing.compression);
    if (packing.predictor != PREDICTOR_NONE)
      TIFFSetField(tiff, TIFFTAG_PREDICTOR, packing.predictor);
    const auto label = [&](std::size_t x, std::size_t y) {
      return static_cast<std::uint16_t>(x < 40 && y < 35 ? labels[first + y * 40 + x] : 0);
    };
    if (is_tiled) {
      TIFFSetField(tiff, TIFFTAG_TILEWIDTH, 32);
      TIFFSetField(tiff, TIFFTAG_TILELENGTH, 16);
      for (std::size_t tile = 0; tile < 6; ++tile) {
        std::vector<std::uint16_t> tile_pixels;
        for (std::size_t i = 0; i < 512; ++i)
          tile_pixels.push_back(label(tile % 2 * 32 + i % 32, tile / 2 * 16 + i / 32));
        TIFFWriteEncodedTile(tiff, static_cast<std::uint32_t>(tile), tile_pixels.data(), 1024);
      }
    } else {
      TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, 16);
      for (std::uint32_t y = 0; y < 35; ++y) {
        std::vector<std::uint16_t> row;
        for (std::size_t x = 0; x < 40; ++x) row.push_back(label(x, y));
        TIFFWriteScanline(tiff, row.data(), y, 0);
      }
    }
    TIFFWriteDirectory(tiff);
  }
  TIFFClose(tiff);
  return testing::content(path);
}

TEST(Tiff, StripsTilesAndPackingsAreTheSame) {
  const auto seed = std::random_device{}();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937_64 random(seed);
  const std::vector<int> labels = testing::random_labels(2800, 3, random);
  const Stack plain = read_spaced(written(labels, {COMPRESSION_NONE}, false, "w"));
  EXPECT_EQ(differing_pixels(plain, 40, 35, labels, number_as_name, 2, 3), 0U);
  for (const Packing& packing :
       {Packing{COMPRESSION_NONE}, Packing{COMPRESSION_LZW}, Packing{COMPRESSION_ADOBE_DEFLATE},
        Packing{COMPRESSION_ADOBE_DEFLATE, PREDICTOR_HORIZONTAL}, Packing{COMPRESSION_DEFLATE},
        Packing{COMPRESSION_PACKBITS}, Packing{COMPRESSION_ZSTD}, Packing{COMPRESSION_LZMA}}) {
    if (TIFFIsCODECConfigured(packing.compression) == 0) continue;
    for (const bool is_tiled : {false, true})
      for (const char* const mode : {"wl", "wb", "w8"})
        EXPECT_EQ(read_spaced(written(labels, packing, is_tiled, mode)), plain)
            << packing.compression << is_tiled << mode;
  }
}

TEST(Tiff, ImageJSaysDistancesAndTheirUnit) {
  const Stack stack = read(read_tiff, tiff_of(of_image_j("spacing=10.0\nunit=mm\n")));
  EXPECT_EQ(stack.unit, "mm");
  EXPECT_EQ(stack.slices[1].z - stack.slices[0].z, 10);
  EXPECT_TRUE(encloses(stack.slices[0], "2", {1, 0.5}));  // two pixels in a unit
  for (const char* const name : {"micron", "um", "\\u00B5m", "\xC2\xB5m", "\xB5m"})
    EXPECT_EQ(read(read_tiff, tiff_of(of_image_j("spacing=3\nunit=" + std::string(name)))).unit,
              "um")
        << name;
  EXPECT_EQ(read(read_tiff, tiff_of(of_image_j("spacing=-3\nunit=pixel\n"))).unit, "");
}

TEST(Tiff, AResolutionGivesTheDistanceThatWasMeant) {
  std::vector<MadePage> pages = of_image_j("spacing=1.5\nunit=um\n", 1 / 0.0649);
  const Stack stack = read(read_tiff, tiff_of(pages), {.outline = Outline::edges});
  double right = 0;
  for (const cdt::Point& point : stack.slices[0].contours[0].points)
    right = std::max(right, point.x);
  EXPECT_NEAR(right, 1.5 * 0.0649, 1e-7);
}

TEST(Tiff, WithoutTheDistanceOfSlicesItIsRefused) {
  EXPECT_THAT(tiff_problem(tiff_of({page(), page()}), {}), HasSubstr("--spacing x,y,z"));
  EXPECT_THAT(tiff_problem(tiff_of(of_image_j("unit=micron\n", 4)), {}),
              HasSubstr("its pixels are 0.25 (x) and 0.25 (y) um apart (ImageJ leaves out a "
                        "distance of 1); give all distances with --spacing x,y,z"));
  EXPECT_THAT(tiff_problem(tiff_of(of_image_j("spacing=0\nunit=micron\n", 4)), {}),
              HasSubstr("--spacing"));
  EXPECT_THAT(tiff_problem(tiff_of(of_image_j("spacing=3\n", 0)), {}),
              HasSubstr("how far its pixels are apart"));
  MadePage inches = page();
  inches.x_resolution = inches.y_resolution = 254;
  inches.resolution_unit = 2;
  EXPECT_THAT(tiff_problem(tiff_of({inches}), {}), HasSubstr("0.1 (x) and 0.1 (y) mm apart"));
}

TEST(Tiff, ASpacingThatIsGivenWins) {
  const Stack stack = read_spaced(tiff_of(of_image_j("spacing=10\nunit=mm\n")));
  EXPECT_EQ(stack.slices[1].z - stack.slices[0].z, 5);
  EXPECT_EQ(stack.unit, "mm");
}

/// All images of an ImageJ file of more than 4 GB are behind the one directory that there is.
std::string without_pages(std::endian order, std::size_t images) {
  MadePage made{.bits = 16};
  made.description = "ImageJ=1.53t\nimages=3\nslices=3\nspacing=5\nunit=um\n";
  made.x_resolution = 0.5;
  made.y_resolution = 1.0 / 3;
  std::string more;
  for (std::size_t image = 0; image < images; ++image)
    for (const char label : two_label_slice)
      append(image == 0 ? made.pixels : more, static_cast<std::uint16_t>(label), order);
  return tiff_of({made}, order) + more;
}

TEST(Tiff, ImageJWritesOneDirectoryForMoreThanFourGigabytes) {
  for (const std::endian order : {std::endian::little, std::endian::big}) {
    const Stack stack = read(read_tiff, without_pages(order, 3));
    ASSERT_EQ(stack.slices.size(), 3U);
    for (const Slice& slice : stack.slices) {
      EXPECT_TRUE(encloses(slice, "1", {2, 0}));
      EXPECT_TRUE(encloses(slice, "2", {4, 3}));
      EXPECT_EQ(slice.contours.size(), 2U);
    }
    EXPECT_THAT(tiff_problem(without_pages(order, 2)), HasSubstr("its description says 3 images"));
  }
}

TEST(Tiff, ChannelsAndTimesAreRefused) {
  EXPECT_THAT(tiff_problem(tiff_of(of_image_j("channels=2\nspacing=2\n"))),
              HasSubstr("2 channels"));
  EXPECT_THAT(tiff_problem(tiff_of(of_image_j("frames=2\nspacing=2\n"))),
              HasSubstr("2 points of time"));
}

std::vector<MadePage> of_ome(const std::string& attributes) {
  std::vector<MadePage> pages{page(), page()};
  pages[0].description =
      "<?xml version=\"1.0\"?><OME xmlns=\"http://www.openmicroscopy.org/Schemas/OME/2016-06\">"
      "<Image><Pixels SizeX=\"3\" SizeY=\"2\" SizeZ=\"2\" " +
      attributes + "><TiffData/></Pixels></Image></OME>";
  return pages;
}

TEST(Tiff, OmeSaysDistancesEachInItsUnit) {
  const Stack stack =
      read(read_tiff, tiff_of(of_ome("PhysicalSizeX=\"0.5\" PhysicalSizeY='500' "
                                     "PhysicalSizeYUnit=\"nm\" PhysicalSizeZ=\"0.003\" "
                                     "PhysicalSizeZUnit=\"mm\"")));
  EXPECT_EQ(stack.unit, "um");
  EXPECT_NEAR(stack.slices[1].z - stack.slices[0].z, 3, 1e-12);
  EXPECT_TRUE(encloses(stack.slices[0], "2", {1, 0.5}));
  EXPECT_EQ(read(read_tiff, tiff_of(of_ome("PhysicalSizeX=\"1\" PhysicalSizeXUnit=\"\xC2\xB5m\" "
                                           "PhysicalSizeY=\"1\" PhysicalSizeYUnit=\"\xC2\xB5m\" "
                                           "PhysicalSizeZ=\"2\" PhysicalSizeZUnit=\"\xC2\xB5m\"")))
                .unit,
            "um");
}

TEST(Tiff, OmeWithoutTheDistanceOfSlicesOrWithChannelsIsRefused) {
  EXPECT_THAT(tiff_problem(tiff_of(of_ome("PhysicalSizeX=\"0.5\" PhysicalSizeY=\"0.5\"")), {}),
              HasSubstr("--spacing"));
  EXPECT_THAT(
      tiff_problem(tiff_of(of_ome("PhysicalSizeX=\"1\" PhysicalSizeY=\"1\" PhysicalSizeZ=\"2\" "
                                  "PhysicalSizeZUnit=\"reference frame\"")),
                   {}),
      HasSubstr("--spacing"));
  EXPECT_THAT(tiff_problem(tiff_of(of_ome("SizeC=\"3\""))), HasSubstr("3 channels"));
  EXPECT_THAT(tiff_problem(tiff_of(of_ome("SizeT=\"4\""))), HasSubstr("4 points of time"));
}

TEST(Tiff, LabelsHaveTheColoursOfAPalette) {
  MadePage made = page();
  made.ink = 3;
  made.palette.assign(768, 0);
  made.palette[0] = 65535;  // the background's colour does not matter
  made.palette[1] = 0x8000;
  made.palette[256 + 2] = 0xFFFF;
  const Stack stack = read_spaced(tiff_of({made, made}));
  EXPECT_EQ(stack.slices, stack_of_pages().slices);
  EXPECT_EQ(stack.find_label("1")->colour, (Colour{128, 0, 0}));
  EXPECT_EQ(stack.find_label("2")->colour, (Colour{0, 255, 0}));
  EXPECT_EQ(stack.labels.size(), 2U);
}

TEST(Tiff, EachColourIsALabelAndBlackIsNone) {
  MadePage made{.samples = 3, .ink = 2};
  made.pixels = {"\0\0\0\xff\0\0\0\0\0\0\0\0\0\0\0\x10\x20\xfe", 18};
  const Stack stack = read_spaced(tiff_of({made, made}));
  EXPECT_EQ(testing::labels_in(stack.slices[0]), (std::vector<std::string>{"#ff0000", "#1020fe"}));
  EXPECT_TRUE(encloses(stack.slices[0], "#ff0000", {2, 0}));
  EXPECT_EQ(stack.find_label("#1020fe")->colour, (Colour{16, 32, 254}));
  MadePage apart{.samples = 3, .ink = 2, .is_separate = true};
  apart.pixels = {"\0\xff\0\0\0\x10\0\0\0\0\0\x20\0\0\0\0\0\xfe", 18};
  EXPECT_EQ(read_spaced(tiff_of({apart, apart})), stack);
}

TEST(Tiff, WhatIsClearIsNoLabel) {
  MadePage made{.samples = 4, .ink = 2, .extra_samples = {2}};
  made.pixels = {"\xff\0\0\0\xff\0\0\x80\xff\0\0\0\xff\0\0\0\xff\0\0\0\1\2\3\xff", 24};
  const Stack stack = read_spaced(tiff_of({made, made}));
  EXPECT_EQ(testing::labels_in(stack.slices[0]), (std::vector<std::string>{"#ff0000", "#010203"}));
  EXPECT_FALSE(encloses(stack.slices[0], "#ff0000", {0, 0}));
  MadePage grey{.samples = 2, .pixels = {"\1\0\1\1\1\0\1\0\1\0\2\1", 12}, .extra_samples = {2}};
  EXPECT_EQ(read_spaced(tiff_of({grey, grey})), stack_of_pages());
}

TEST(Tiff, WhereZeroIsWhiteItIsStillTheBackground) {
  MadePage made = page();
  made.ink = 0;
  EXPECT_EQ(read_spaced(tiff_of({made, made})), stack_of_pages());
}

TEST(Tiff, PreviewsAreLeftOut) {
  MadePage preview{.columns = 1, .rows = 1, .pixels = {"\7", 1}, .kind = 1};
  EXPECT_EQ(read_spaced(tiff_of({page(), preview, page()})), stack_of_pages());
  EXPECT_THAT(tiff_problem(tiff_of({preview})), HasSubstr("has previews or masks only"));
}

TEST(Tiff, PagesOfOtherSizesAreRefused) {
  MadePage wide{.columns = 6, .rows = 1, .pixels = two_label_slice};
  EXPECT_THAT(tiff_problem(tiff_of({page(), wide})),
              HasSubstr("a.file: page 2: is of 6 x 1 pixels, a.file: page 1 of 3 x 2"));
}

TEST(Tiff, PackingsThatChangeLabelsAreRefusedByName) {
  MadePage made = page();
  made.compression = 7;
  EXPECT_THAT(tiff_problem(tiff_of({made})), HasSubstr("page 1: is compressed by JPEG"));
  made.compression = 4;
  EXPECT_THAT(tiff_problem(tiff_of({made})), HasSubstr("fax group 4"));
  made.compression = 12345;
  EXPECT_THAT(tiff_problem(tiff_of({made})), HasSubstr("12345"));
}

TEST(Tiff, SizesThatAreMoreThanTheFileAreRefusedBeforeMemoryIsTaken) {
  for (const std::uint16_t compression : {std::uint16_t{1}, std::uint16_t{8}}) {
    MadePage made = page();
    made.compression = compression;
    made.columns = made.rows = 0x7fffffff;
    EXPECT_NE(tiff_problem(tiff_of({made})), "nothing");
    made.columns = made.rows = 30000;
    EXPECT_THAT(tiff_problem(tiff_of({made})), HasSubstr("more than the file can hold"));
  }
}

TEST(Tiff, SaysWhatIsWrong) {
  EXPECT_THAT(tiff_problem("II*\0garbage"), HasSubstr("a.file: "));
  EXPECT_THAT(tiff_problem("P5\n"), HasSubstr("a.file: is no TIFF"));
  MadePage made{.samples = 2, .pixels = two_label_slice + two_label_slice};
  EXPECT_THAT(tiff_problem(tiff_of({made})), HasSubstr("2 values where 1 is read"));
  made = {.bits = 16, .format = 3, .pixels = two_label_slice + two_label_slice};
  EXPECT_THAT(tiff_problem(tiff_of({made})), HasSubstr("16 bits and format 3"));
  made = {.samples = 4,
          .ink = 5,
          .pixels = two_label_slice + two_label_slice + two_label_slice + two_label_slice};
  EXPECT_THAT(tiff_problem(tiff_of({made})), HasSubstr("photometric 5"));
}

TEST(Tiff, DirectoriesThatLeadBackAreRefused) {
  testing::TiffWriter writer(std::endian::little);
  writer.add(page());
  writer.add(page());
  EXPECT_THAT(tiff_problem(writer.file(8)), HasSubstr("a.file: page 3 cannot be read"));
}

TEST(Tiff, NothingIsPrinted) {
  ::testing::internal::CaptureStderr();
  const std::string good = written(std::vector<int>(1400, 1), {COMPRESSION_LZW}, false, "w");
  for (std::size_t size = 4; size < good.size(); size += 7)
    static_cast<void>(tiff_problem(good.substr(0, size)));
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST(Tiff, CutOffAnywhereItIsRefused) {
  testing::expect_no_cut_hurts(read_tiff, tiff_of(of_image_j("spacing=2\nunit=um\n")));
  testing::expect_no_cut_hurts(read_tiff, without_pages(std::endian::big, 3));
}

TEST(Tiff, SeveralFilesOfOnePageAreASeriesInNaturalOrder) {
  const Folder folder;
  MadePage second = page();
  second.pixels[1] = 3;
  const auto low = folder.write("slice_2.tif", tiff_of({page()}));
  const auto high = folder.write("slice_10.tif", tiff_of({second}));
  const std::vector paths{high, low};  // as a shell has them
  const Stack stack = read_stack(paths, spaced);
  ASSERT_EQ(stack.slices.size(), 2U);
  EXPECT_TRUE(encloses(stack.slices[0], "1", {2, 0}));
  EXPECT_TRUE(encloses(stack.slices[1], "3", {2, 0}));
  EXPECT_EQ(read_stack(folder / "", spaced), stack);
  const auto whole = folder.write("slice_11.tif", tiff_of({page(), page()}));
  EXPECT_THAT(testing::message_of<InputError>([&] {
                static_cast<void>(read_stack(std::vector{low, whole}, spaced));
              }),
              HasSubstr("has 2 pages"));
}

}  // namespace
}  // namespace loft::io
