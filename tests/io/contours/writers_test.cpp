// SPDX-License-Identifier: MIT
// Formats in which it is an outline's direction, or what is beside it, that says what is inside.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <sstream>

#include "io/contours/cli.h"
#include "io/contours/cli_writer.h"
#include "io/contours/contour_writer.h"
#include "io/contours/csl.h"
#include "io/contours/slice_outlines.h"
#include "tests/io/stacks/readers.h"

namespace loft::io {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::labels_in;
using testing::read;
using Points = std::vector<cdt::Point>;
using Writer = std::vector<std::string> (*)(std::ostream&, const Stack&);

struct Written {
  std::string text;
  std::vector<std::string> losses;
};

Written write(Writer writer, const Stack& stack) {
  std::ostringstream out;
  auto losses = writer(out, stack);
  return {out.str(), std::move(losses)};
}

Points square(double x, double y, double side) {
  return {{x, y}, {x + side, y}, {x + side, y + side}, {x, y + side}};
}

/// The edges around what each label encloses: places from and to, sorted.
std::vector<std::array<double, 4>> edges(const Stack& stack, std::uint32_t slice) {
  std::vector<std::array<double, 4>> result;
  for (const auto& [label, region] : slice_outlines(stack, slice))
    for (const Segment& edge : boundary(region))
      result.push_back({edge[0].x, edge[0].y, edge[1].x, edge[1].y});
  std::ranges::sort(result);
  return result;
}

/// A square with a hole, one beside it that shares a side, and an empty slice in between.
Stack two_labels() {
  Stack stack;
  stack.unit = "um";
  stack.slices = {
      {0.1, {{square(0, 0, 4), "wall"}, {square(1, 1, 2), "wall"}, {square(4, 0, 4), "room"}}},
      {0.2, {}},
      {0.30000000000000004, {{square(0, 0, 4), "wall"}}}};
  return stack;
}

TEST(CliWriter, WritesHolesPartsUnitsAndEmptyLayers) {
  const Written written = write(write_cli, two_labels());
  EXPECT_EQ(written.text,
            "$$HEADERSTART\r\n$$ASCII\r\n$$UNITS/0.001\r\n$$VERSION/200\r\n$$LABEL/1,room\r\n"
            "$$LABEL/2,wall\r\n$$DIMENSION/0,0,0.0001,0.008,0.004,0.00030000000000000003\r\n"
            "$$LAYERS/3\r\n$$HEADEREND\r\n$$GEOMETRYSTART\r\n"
            "$$LAYER/0.1\r\n$$POLYLINE/1,1,5,4,0,8,0,8,4,4,4,4,0\r\n"
            "$$POLYLINE/2,1,5,0,0,4,0,4,4,0,4,0,0\r\n$$POLYLINE/2,0,5,1,1,1,3,3,3,3,1,1,1\r\n"
            "$$LAYER/0.2\r\n"
            "$$LAYER/0.30000000000000004\r\n$$POLYLINE/2,1,5,0,0,4,0,4,4,0,4,0,0\r\n"
            "$$GEOMETRYEND\r\n");
  EXPECT_TRUE(written.losses.empty());
}

TEST(CliWriter, KeepsCoordinatesAndLabels) {
  Stack stack = two_labels();
  stack.unit = "mm";
  stack.slices[0].contours[0].points[1].x = 4.000000000000001;
  const Stack again = read(read_cli, write(write_cli, stack).text);
  ASSERT_EQ(again.slices.size(), 3U);
  for (std::uint32_t s = 0; s < 3; ++s) {
    EXPECT_EQ(again.slices[s].z, stack.slices[s].z);
    EXPECT_EQ(edges(again, s), edges(stack, s));
  }
  EXPECT_THAT(labels_in(again.slices[0]), ElementsAre("room", "wall", "wall"));
}

TEST(CliWriter, SaysWhatItCannotHold) {
  Stack stack = two_labels();
  stack.unit = "pixel";
  stack.labels = {{"wall", Colour{1, 2, 3}}};
  stack.slices[1].contours = {{{{0, 0}, {1, 1}}, "wall"}};
  EXPECT_THAT(write(write_cli, stack).losses,
              ElementsAre("CLI is in mm, and the stack's unit 'pixel' is no length: taken as mm",
                          "contours without an area: 1 left out", "CLI has no colours: left out"));
  stack.frame = WorldFrame{{{{1, 0, 0, 0}, {0, 0, -1, 0}, {0, 1, 0, 0}, {0, 0, 0, 1}}}};
  EXPECT_THAT(write(write_cli, stack).losses, Contains(HasSubstr("no tilted planes")));
}

TEST(CliWriter, TurnsOutlinesRoundWhereTheWorldIsUpsideDown) {
  Stack stack = two_labels();
  stack.frame = WorldFrame{{{{1, 0, 0, 10}, {0, -1, 0, 0}, {0, 0, -1, 5}, {0, 0, 0, 1}}}};
  const Stack again = read(read_cli, write(write_cli, stack).text);
  EXPECT_DOUBLE_EQ(again.slices[0].z, 0.001 * (5 - 0.30000000000000004));
  const auto regions = slice_outlines(again, 2);
  ASSERT_EQ(regions.size(), 2U);
  EXPECT_NEAR(area(regions[0].region), 16e-6, 1e-12);
  EXPECT_NEAR(area(regions[1].region), 12e-6, 1e-12);
}

TEST(CliWriter, NamesStayOnTheirLine) {
  Stack stack = two_labels();
  stack.slices[0].contours[2].label = "a$$HEADEREND\nb";
  const Stack again = read(read_cli, write(write_cli, stack).text);
  EXPECT_EQ(again.slices[0].contours[0].label, "a$_HEADEREND_b");
}

TEST(CliWriter, WritesNoExponents) {
  Stack stack = two_labels();
  stack.slices[0].contours[2].points[0].x = 1e-20;
  stack.slices[0].contours[2].points[1].x = 1e22;
  EXPECT_EQ(write(write_cli, stack).text.find('e', 200), std::string::npos);
}

TEST(ContourWriter, SharesEdges) {
  const Written written = write(write_contour, two_labels());
  EXPECT_EQ(written.text.substr(0, 26), "3\n0 0 1 -0.1\n10 11\n4 4 0.1");
  // The shared side: label 1, room, is on the left of it as it goes down.
  EXPECT_NE(written.text.find("\n0 1 1 2\n"), std::string::npos) << written.text;
  EXPECT_THAT(written.losses,
              Contains(".contour has no names, and no colours: 1 is 'room', 2 is 'wall'"));
}

TEST(ContourWriter, IsReadAgain) {
  const Stack stack = two_labels();
  const Stack again = read(read_contour, write(write_contour, stack).text);
  ASSERT_EQ(again.slices.size(), 3U);
  for (std::uint32_t s = 0; s < 3; ++s) {
    EXPECT_EQ(again.slices[s].z, stack.slices[s].z);
    EXPECT_EQ(edges(again, s), edges(stack, s));
  }
  EXPECT_THAT(labels_in(again.slices[2]), ElementsAre("material 2"));
}

TEST(ContourWriter, KeepsTiltedPlanes) {
  Stack stack = two_labels();
  stack.frame = WorldFrame{{{{0, 0, 1, 3}, {0.6, -0.8, 0, 0}, {0.8, 0.6, 0, 0}, {0, 0, 0, 1}}}};
  const Stack again = read(read_contour, write(write_contour, stack).text);
  ASSERT_EQ(again.slices.size(), 3U);
  const auto regions = slice_outlines(again, 0);
  ASSERT_EQ(regions.size(), 2U);
  EXPECT_NEAR(area(regions[0].region), 16, 1e-12);
  EXPECT_NEAR(area(regions[1].region), 12, 1e-12);
  EXPECT_NEAR(again.slices[1].z - again.slices[0].z, 0.1, 1e-12);
}

/// What contours enclose stays the same, however they cross and whatever the rule.
TEST(Writers, KeepWhatRandomContoursEnclose) {
  const auto seed = std::random_device()();
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> place(0, 12);
  for (int round = 0; round < 60; ++round) {
    Stack stack;
    stack.unit = "mm";
    stack.fill = round % 2 == 0 ? Fill::even_odd : Fill::nonzero;
    Slice slice{1.5, {}};
    for (int c = 0; c < 3; ++c) {
      Points points(3 + random() % 5);
      for (cdt::Point& p : points) p = {0.1 * place(random), 0.1 * place(random)};
      slice.contours.push_back({std::move(points), "a"});
    }
    stack.slices = {slice};
    if (edges(stack, 0).empty()) continue;
    EXPECT_EQ(edges(read(read_cli, write(write_cli, stack).text), 0), edges(stack, 0)) << round;
    EXPECT_EQ(edges(read(read_contour, write(write_contour, stack).text), 0), edges(stack, 0))
        << round;
  }
}

}  // namespace
}  // namespace loft::io
