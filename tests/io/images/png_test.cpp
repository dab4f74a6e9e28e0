// SPDX-License-Identifier: MIT
#include "io/images/png.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "io/stack.h"
#include "tests/io/images/made_png.h"
#include "tests/io/images/spaced.h"
#include "tests/io/volumes/masks.h"

namespace loft::io {
namespace {

using ::testing::Contains;
using testing::differing_pixels;
using testing::encloses;
using testing::Folder;
using ::testing::HasSubstr;
using testing::labels_in;
using testing::MadePng;
using ::testing::Not;
using testing::number_as_name;
using testing::spaced;

Stack read(const std::vector<MadePng>& made, const ReadOptions& options = spaced) {
  std::vector<std::string> files;
  std::vector<StackInput> inputs;
  for (const MadePng& png : made) files.push_back(png.bytes());
  for (std::size_t i = 0; i < files.size(); ++i)
    inputs.push_back({files[i], "a" + std::to_string(i) + ".png"});
  return read_png_series(inputs, options);
}
std::string problem(const std::vector<MadePng>& made, const ReadOptions& options = spaced) {
  return testing::message_of<InputError>([&] { static_cast<void>(read(made, options)); });
}
std::string png_problem(std::string_view bytes) {
  return testing::problem(read_png, bytes, spaced);
}

/// 3 x 2 pixels of which (1, 0) is 1 and (2, 1) is 2.
MadePng image() { return {.samples = {0, 1, 0, 0, 0, 2}}; }
Stack stack_of_images() { return read({image(), image()}); }

TEST(Png, ImagesAreSlicesAndRowsRunAlongY) {
  const Stack stack = stack_of_images();
  ASSERT_EQ(stack.slices.size(), 2U);
  EXPECT_EQ(stack.slices[1].z - stack.slices[0].z, 5);
  EXPECT_TRUE(encloses(stack.slices[0], "1", {2, 0}));
  EXPECT_TRUE(encloses(stack.slices[1], "2", {4, 3}));
}

TEST(Png, OutlinesEncloseItsPixelsAndNoOthersWhateverTheBits) {
  const auto seed = std::random_device{}();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937_64 random(seed);
  for (const unsigned depth : {1U, 2U, 4U, 8U, 16U}) {
    const int most = depth < 4 ? (1 << depth) - 1 : depth == 16 ? 6 : 9;
    std::vector<int> labels = testing::random_labels(std::size_t{11} * 9 * 3, most, random);
    if (depth == 16)
      for (int& label : labels) label *= 300;
    for (const bool is_interlaced : {false, true}) {
      std::vector<MadePng> made(3, {.columns = 11, .rows = 9, .depth = depth});
      for (std::size_t i = 0; i < 3; ++i) {
        made[i].samples.assign(&labels[i * 99], &labels[i * 99] + 99);
        made[i].is_interlaced = is_interlaced;
      }
      for (const Outline outline : {Outline::iso_lines, Outline::edges}) {
        const Stack stack = read(made, {.spacing = Vec3{2, 3, 5}, .outline = outline});
        EXPECT_EQ(differing_pixels(stack, 11, 9, labels, number_as_name, 2, 3), 0U) << depth;
      }
    }
  }
}

TEST(Png, SeveralFilesAndFoldersAreASeriesInNaturalOrder) {
  const Folder folder;
  MadePng high = image();
  high.samples[1] = 3;
  const std::vector paths{folder.write("slice_10.png", high.bytes()),
                          folder.write("slice_2.png", image().bytes())};
  static_cast<void>(folder.write("words.md", "of something else"));
  const Stack stack = read_stack(paths, spaced);
  ASSERT_EQ(stack.slices.size(), 2U);
  EXPECT_TRUE(encloses(stack.slices[0], "1", {2, 0}));
  EXPECT_TRUE(encloses(stack.slices[1], "3", {2, 0}));
  EXPECT_EQ(read_stack(folder / "", spaced), stack);
}

TEST(Png, ASeriesIsOfOneFormat) {
  const Folder folder;
  const std::vector paths{folder.write("a.png", image().bytes()),
                          folder.write("b.png", std::string("II*\0", 4))};
  EXPECT_THAT(
      testing::message_of<InputError>([&] { static_cast<void>(read_stack(paths, spaced)); }),
      HasSubstr("is not of the format of"));
}

TEST(Png, SpacingIsAskedForWithWhatIsKnownOfIt) {
  EXPECT_THAT(problem({image()}, {}), HasSubstr("a0.png: it does not say how far"));
  MadePng made = image();
  made.per_metre = 10000;
  EXPECT_THAT(problem({made}, {}),
              HasSubstr("its pixels are 0.1 (x) and 0.1 (y) mm apart; give all distances with "
                        "--spacing x,y,z"));
  EXPECT_THAT(problem({made}, {.spacing = Vec3{1, 1, 0}}), HasSubstr("three positive numbers"));
}

MadePng of_palette() {
  MadePng made = image();
  made.kind = 3;
  made.palette = std::string("\xff\xff\xff\x10\x20\x30\xff\0\0", 9);
  return made;
}

TEST(Png, PlacesInAPaletteAreLabelsOfItsColours) {
  const Stack stack = read({of_palette(), of_palette()});
  EXPECT_EQ(stack.slices, stack_of_images().slices);
  EXPECT_EQ(stack.find_label("1")->colour, (Colour{16, 32, 48}));
  EXPECT_EQ(stack.find_label("2")->colour, (Colour{255, 0, 0}));
  MadePng clear = of_palette();
  clear.clear = std::string("\0\0", 2);
  EXPECT_EQ(labels_in(read({clear, clear}).slices[0]), std::vector<std::string>{"2"});
}

TEST(Png, APaletteOfFewerColoursMayBeTheBeginningOfAnother) {
  MadePng longer = of_palette();
  longer.palette += "abc";
  longer.samples[5] = 3;
  const Stack stack = read({of_palette(), longer});
  EXPECT_EQ(labels_in(stack.slices[1]), (std::vector<std::string>{"1", "3"}));
  EXPECT_EQ(stack.find_label("3")->colour, (Colour{'a', 'b', 'c'}));
}

TEST(Png, OfPalettesThatAreNotTheSameTheColoursCount) {
  MadePng other{.kind = 3, .samples = {0, 2, 0, 0, 0, 1}};
  other.palette = std::string("\0\0\0\xff\0\0\x10\x20\x30", 9);  // as of_palette(), swapped
  MadePng first = of_palette();
  first.palette.replace(0, 3, 3, '\0');
  const Stack stack = read({first, other});
  for (const Slice& slice : stack.slices) {
    EXPECT_EQ(labels_in(slice).size(), 2U);
    EXPECT_TRUE(encloses(slice, "#102030", {2, 0}));
    EXPECT_TRUE(encloses(slice, "#ff0000", {4, 3}));
  }
}

TEST(Png, EachColourIsALabelAndBlackOrClearIsNone) {
  MadePng made{.kind = 2, .samples = {0, 0, 0, 255, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 16, 32, 48}};
  const Stack stack = read({made, made});
  EXPECT_EQ(labels_in(stack.slices[0]), (std::vector<std::string>{"#ff0000", "#102030"}));
  EXPECT_TRUE(encloses(stack.slices[0], "#ff0000", {2, 0}));
  EXPECT_EQ(stack.find_label("#102030")->colour, (Colour{16, 32, 48}));
  MadePng alpha{.kind = 6};
  for (std::size_t i = 0; i < 18; i += 3) {
    alpha.samples.insert(alpha.samples.end(), {255, 0, 0});
    alpha.samples.push_back(i == 3 ? 128 : 0);
  }
  const Stack clear = read({alpha, alpha});
  EXPECT_EQ(labels_in(clear.slices[0]), std::vector<std::string>{"#ff0000"});
  EXPECT_EQ(clear.slices[0].contours.size(), 1U);
}

TEST(Png, ColoursOfSixteenBitsAreBroughtToEight) {
  MadePng made{.depth = 16, .kind = 2, .samples = std::vector<int>(18)};
  made.samples[3] = 65535;
  made.samples[5] = 0x2020;
  EXPECT_EQ(labels_in(read({made}).slices[0]), std::vector<std::string>{"#ff0020"});
}

TEST(Png, AValueOrColourThatIsClearIsNone) {
  MadePng grey = image();
  grey.clear = std::string("\0\2", 2);
  EXPECT_EQ(labels_in(read({grey, grey}).slices[0]), std::vector<std::string>{"1"});
  MadePng made{.kind = 2, .samples = std::vector<int>(18, 9)};
  made.samples[0] = 255;
  made.clear = std::string("\0\x9\0\x9\0\x9", 6);
  EXPECT_EQ(read({made}).slices[0].contours.size(), 1U);
}

TEST(Png, ImagesThatAProgramMadeSmallerMeanTheSameAsTheOthers) {
  MadePng mask{.samples = {0, 255, 0, 0, 0, 255}};
  MadePng small{.depth = 1, .samples = {0, 1, 0, 0, 0, 1}};
  const Stack stack = read({mask, small, {.depth = 1, .samples = std::vector<int>(6)}});
  EXPECT_EQ(stack.slices[0].contours, stack.slices[1].contours);
  EXPECT_TRUE(stack.slices[2].contours.empty());
  // Among colours grey is one of them.
  MadePng colours{.kind = 2, .samples = std::vector<int>(18, 255)};
  const Stack mixed = read({colours, small});
  EXPECT_EQ(mixed.labels.size(), 1U);
  EXPECT_TRUE(encloses(mixed.slices[1], "#ffffff", {2, 0}));
}

/// A square of white whose edges go from 0 to 255 in soft steps.
MadePng soft() {
  MadePng made{.columns = 40, .rows = 40, .samples = std::vector<int>(1600)};
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 40; ++x)
      if (x >= 4 && x <= 35 && y >= 4 && y < 36)
        made.samples[static_cast<std::size_t>(y * 40 + x)] = x == 4    ? 40 + 5 * y
                                                             : x == 35 ? 60
                                                                       : 255;
  return made;
}

TEST(Png, SoftEdgesAreLabelsUnlessALevelIsGivenAndSaid) {
  EXPECT_THAT(read({soft(), soft()}).notes, Contains(HasSubstr("give --level 128")));
  const Stack stack = read({soft(), soft()}, {.spacing = Vec3{1, 1, 2}, .level = 128});
  EXPECT_EQ(stack.slices[0].contours.size(), 1U);
  EXPECT_THAT(stack.notes, Not(Contains(HasSubstr("--level"))));
  // At the right the level is crossed between 255 and 60.
  const double right = 34 + 127.0 / 195;
  double most = 0;
  for (const cdt::Point& point : stack.slices[0].contours[0].points) most = std::max(most, point.x);
  EXPECT_NEAR(most, right, 1e-12);
  EXPECT_THAT(stack_of_images().notes, Not(Contains(HasSubstr("--level"))));
}

TEST(Png, ALevelIsNoneOfColours) {
  EXPECT_THAT(problem({of_palette()}, {.spacing = Vec3{1, 1, 1}, .level = 1}),
              HasSubstr("leave out --level"));
}

TEST(Png, ImagesOfOtherSizesAreRefused) {
  MadePng wide{.columns = 6, .rows = 1, .samples = image().samples};
  EXPECT_THAT(problem({image(), wide}), HasSubstr("a1.png: is of 6 x 1 pixels, a0.png of 3 x 2"));
}

TEST(Png, SizesThatAreMoreThanTheFileAreRefusedBeforeMemoryIsTaken) {
  const std::string bytes = image().bytes();
  const auto claims = [&](std::uint32_t columns, std::uint32_t rows) {
    std::string head;
    testing::append(head, columns, std::endian::big);
    testing::append(head, rows, std::endian::big);
    std::string checked = "IHDR" + head + bytes.substr(24, 5);
    std::string sum;
    testing::append(
        sum,
        static_cast<std::uint32_t>(crc32(0, reinterpret_cast<const Bytef*>(checked.data()),
                                         static_cast<uInt>(checked.size()))),
        std::endian::big);
    return bytes.substr(0, 12) + checked + sum + bytes.substr(33);
  };
  EXPECT_THAT(png_problem(claims(20000, 20000)), HasSubstr("which so small a file cannot hold"));
  EXPECT_NE(png_problem(claims(0x7fffffff, 0x7fffffff)), "nothing");
  EXPECT_NE(png_problem(claims(0x80000000, 1)), "nothing");
  EXPECT_NE(png_problem(claims(0, 1)), "nothing");
}

TEST(Png, DamageIsNamedAndNothingIsPrinted) {
  ::testing::internal::CaptureStderr();
  const std::string good = image().bytes();
  EXPECT_THAT(png_problem("II*"), HasSubstr("a.file: byte 0: is no PNG"));
  for (std::size_t i = 8; i < good.size(); ++i) {
    std::string bad = good;
    bad[i] = static_cast<char>(bad[i] ^ 0x55);
    EXPECT_THAT(png_problem(bad), ::testing::AnyOf(HasSubstr("a.file"), "nothing")) << i;
  }
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST(Png, IsRefusedCutOffAnywhere) {
  const std::string good = of_palette().bytes();
  for (std::size_t size = 0; size < good.size(); ++size)
    EXPECT_THAT(png_problem(good.substr(0, size)), HasSubstr("a.file: byte ")) << size;
}

}  // namespace
}  // namespace loft::io
