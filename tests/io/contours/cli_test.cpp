// SPDX-License-Identifier: MIT
#include "io/contours/cli.h"

#include "tests/io/stacks/readers.h"

namespace loft::io {
namespace {

using testing::append;
using testing::problem;
using testing::read;

/// `more` are further entries of the header.
std::string header(const std::string& more = "$$ASCII\n") {
  return "$$HEADERSTART\n$$UNITS/00000000.500000\n$$LABEL/1,bracket\n" + more + "$$HEADEREND";
}

constexpr auto little = std::endian::little;

void append_layer(std::string& bytes, std::uint16_t z) {
  append(bytes, std::uint16_t{128}, little);
  append(bytes, z, little);
}

/// A closed square of side 10 with a corner, and its first point repeated.
void append_square(std::string& bytes, std::int16_t x, std::int16_t y, std::uint16_t count = 5) {
  for (const std::uint16_t head : {std::uint16_t{129}, std::uint16_t{1}, std::uint16_t{1}, count})
    append(bytes, head, little);
  const int steps[5][2] = {{0, 0}, {10, 0}, {10, 10}, {0, 10}, {0, 0}};
  for (const auto& step : steps) {
    append(bytes, static_cast<std::int16_t>(x + step[0]), little);
    append(bytes, static_cast<std::int16_t>(y + step[1]), little);
  }
}

std::string binary(const std::string& more = "") { return header("$$BINARY\n" + more); }

TEST(Cli, ReadsAsciiWithUnitsLabelsAndPaddedNumbers) {
  const Stack stack = read(read_cli, header() +
                                         "$$GEOMETRYSTART\r\n$$POWER/200\r\n$$LAYER/-2.0\r\n"
                                         "$$POLYLINE/1,1,4,0,0,-00004.0000,0,4,6,0,0\r\n"
                                         "$$HATCHES/1,2,0,0,1,1,2,2,3,3\r\n$$LAYER/2\r\n"
                                         "$$POLYLINE/1,2,2,0,0,1,1 // a support //\r\n"
                                         "$$GEOMETRYEND\r\n");
  EXPECT_EQ(stack.unit, "mm");
  EXPECT_EQ(stack.fill, Fill::nonzero);
  EXPECT_EQ(stack.labels, (std::vector<StackLabel>{{"bracket", {}, "1", "", {}}}));
  ASSERT_EQ(stack.slices.size(), 2U);  // the empty one, too
  EXPECT_EQ(stack.slices[0].z, -1);
  const Contour& contour = stack.slices[0].contours.at(0);
  // Outside, but clockwise: turned round.
  EXPECT_EQ(contour.points, (std::vector<cdt::Point>{{0, 0}, {2, 3}, {-2, 0}}));
  EXPECT_EQ(contour.label, "bracket");
  EXPECT_EQ(contour.source, "line 8");
  EXPECT_EQ(stack.notes,
            (std::vector<std::string>{"label 'bracket': 2 hatch lines, 1 open polyline left out"}));
}

TEST(Cli, TurnsContoursAsTheirDirectionSays) {
  const std::string square = ",5,0,0,4,0,4,4,0,4,0,0";
  const Stack stack =
      read(read_cli, header() + "$$LAYER/1$$POLYLINE/1,1" + square + "$$POLYLINE/1,0" + square);
  ASSERT_EQ(stack.slices.at(0).contours.size(), 2U);
  EXPECT_EQ(stack.slices[0].contours[0].points,
            (std::vector<cdt::Point>{{0, 0}, {2, 0}, {2, 2}, {0, 2}}));
  EXPECT_EQ(stack.slices[0].contours[1].points,
            (std::vector<cdt::Point>{{0, 0}, {0, 2}, {2, 2}, {2, 0}}));
}

TEST(Cli, ReadsShortBinaryCoordinatesAsSignedWhereDimensionSaysSo) {
  std::string bytes = binary("$$DIMENSION/-00003.0,-5.0,0.0,00002.0,0.0,1.0\n");
  append_layer(bytes, 0);
  append_square(bytes, -6, -10);
  append_layer(bytes, 40'000);
  append_square(bytes, -6, -10);
  const Stack stack = read(read_cli, bytes);
  ASSERT_EQ(stack.slices.size(), 2U);
  EXPECT_EQ(stack.slices[1].z, 20'000);
  EXPECT_EQ(stack.slices[0].contours.at(0).points,
            (std::vector<cdt::Point>{{-3, -5}, {2, -5}, {2, 0}, {-3, 0}}));
  EXPECT_EQ(stack.slices[0].contours[0].source, "byte " + std::to_string(bytes.find("END") + 7));
}

TEST(Cli, ReadsShortBinaryCoordinatesAsUnsignedWhereDimensionSaysSo) {
  std::string bytes = binary("$$DIMENSION/20000,20000,0,20005,20005,1\n");
  append_layer(bytes, 0);
  append_square(bytes, static_cast<std::int16_t>(40'000 - 65'536),
                static_cast<std::int16_t>(40'000 - 65'536));
  EXPECT_EQ(read(read_cli, bytes).slices.at(0).contours.at(0).points[0],
            (cdt::Point{20'000, 20'000}));
}

TEST(Cli, TakesTheSmallerExtentWithoutDimension) {
  std::string bytes = binary();
  append_layer(bytes, 0);
  append_square(bytes, -6, -6);
  EXPECT_EQ(read(read_cli, bytes).slices.at(0).contours.at(0).points[0], (cdt::Point{-3, -3}));
  bytes = binary();
  append_layer(bytes, 0);
  append_square(bytes, 32'762, 32'762);  // to 32,772
  EXPECT_EQ(read(read_cli, bytes).slices.at(0).contours.at(0).points[2],
            (cdt::Point{16'386, 16'386}));
}

TEST(Cli, ReadsLongBinaryCommandsAndAlignedOnes) {
  for (const bool aligned : {false, true}) {
    std::string bytes = binary(aligned ? "$$ALIGN\n" : "");
    const auto command = [&](std::uint16_t number) {
      append(bytes, number, little);
      if (aligned) bytes += std::string(2, '\0');
    };
    command(127);
    append(bytes, 1.5F, little);
    command(130);
    for (const std::int32_t head : {1, 1, 3}) append(bytes, head, little);
    for (const float x : {0.0F, 0.0F, 4.5F, 0.0F, 0.0F, 4.0F}) append(bytes, x, little);
    command(132);
    for (const std::int32_t head : {1, 1}) append(bytes, head, little);
    bytes += std::string(16, '\0');
    const Stack stack = read(read_cli, bytes);
    EXPECT_EQ(stack.slices.at(0).z, 0.75);
    EXPECT_EQ(stack.slices[0].contours.at(0).points,
              (std::vector<cdt::Point>{{0, 0}, {2.25, 0}, {0, 2}}));
    EXPECT_EQ(stack.notes.at(0), "label 'bracket': 1 hatch line left out");
  }
}

TEST(Cli, SaysThatNothingIsClosed) {
  const std::string text =
      problem(read_cli, header() + "$$LAYER/1$$POLYLINE/1,2,2,0,0,1,1$$LAYER/2");
  EXPECT_NE(text.find("no closed outline in it, only 1 open polyline"), std::string::npos) << text;
}

TEST(Cli, KeepsPartsOfOneNameApart) {
  const std::string triangle = ",1,3,0,0,4,0,0,4";
  const Stack stack =
      read(read_cli, header("$$LABEL/2,bracket\n$$LABEL/7,\n") + "$$LAYER/1" + "$$POLYLINE/1" +
                         triangle + "$$POLYLINE/2" + triangle + "$$POLYLINE/7" + triangle);
  EXPECT_EQ(testing::labels_in(stack.slices.at(0)),
            (std::vector<std::string>{"bracket (part 1)", "bracket (part 2)", "part 7"}));
}

TEST(Cli, CountsTheLayersThatTheHeaderPromises) {
  const Stack stack =
      read(read_cli, header("$$LAYERS/000003\n") + "$$LAYER/1$$POLYLINE/1,1,3,0,0,4,0,0,4");
  EXPECT_EQ(stack.notes.at(0),
            "only 1 of the 3 layers that the header counts are there; was the file cut off?");
}

TEST(Cli, ListsWhatIsWrong) {
  EXPECT_NE(problem(read_cli, "$$HEADERSTART").find("$$HEADEREND is missing"), std::string::npos);
  EXPECT_NE(problem(read_cli, "$$HEADERSTART$$HEADEREND").find("$$UNITS is missing"),
            std::string::npos);
  EXPECT_NE(
      problem(read_cli, "$$HEADERSTART\n$$UNITS/0$$HEADEREND").find("a.file:2: $$UNITS: '0' is no"),
      std::string::npos);
  EXPECT_EQ(problem(read_cli, header() + "\n$$LAYER/nan\n$$POLYLINE/1,1,3,0,0\n$$LAYER/2\n" +
                                  "$$POLYLINE/1,5,1,0,0\n$$POLYLINE/1,1,2000000000,0,0"),
            "a.file: line 6: expected a height, found 'nan'\n"
            "a.file: line 7: a polyline of 3 points has 2 coordinates; it is cut off or damaged\n"
            "a.file: line 9: the direction 5 of a polyline is none; 0 is inside, 1 outside, 2 "
            "open\n"
            "a.file: line 10: a polyline of 2000000000 points has 2 coordinates; it is cut off or "
            "damaged");
}

TEST(Cli, NamesTheByteOfWhatIsWrong) {
  std::string bytes = binary();
  const std::string begin = "a.file: byte " + std::to_string(bytes.size());
  append_layer(bytes, 0);
  const std::string good = bytes;
  append_square(bytes, 0, 0, 0xFFFF);
  EXPECT_NE(problem(read_cli, bytes).find("262140 bytes should come, the file ends after 20"),
            std::string::npos);
  bytes = binary();
  append(bytes, std::uint16_t{999}, little);
  EXPECT_EQ(problem(read_cli, bytes),
            begin + ": the command 999 is unknown, and where it ends; save the file as ASCII");
  bytes = good;
  append(bytes, std::uint16_t{130}, little);
  for (const std::int32_t head : {1, 1, -3}) append(bytes, head, little);
  EXPECT_NE(problem(read_cli, bytes).find("a count of points is negative"), std::string::npos);
}

TEST(Cli, IsHurtByNoCut) {
  std::string bytes = binary("$$DIMENSION/-3,-5,0,2,0,1\n");
  append_layer(bytes, 0);
  append_square(bytes, -6, -10);
  testing::expect_no_cut_hurts(read_cli, bytes);
  testing::expect_no_cut_hurts(read_cli, header() + "\n$$LAYER/1\n$$POLYLINE/1,1,3,0,0,4,0,0,4\n");
}

}  // namespace
}  // namespace loft::io
