// SPDX-License-Identifier: MIT
#include "io/contours/jser.h"

#include <cmath>

#include "tests/io/stacks/readers.h"

namespace loft::io {
namespace {

using testing::problem;
using testing::read;
using Points = std::vector<cdt::Point>;

/// A trace as a list: a square with its lower left corner and side.
std::string square_trace(double x, double y, double side, const char* flags = "true,false,false") {
  const auto text = [](double a, double b, double c, double d) {
    return '[' + std::to_string(a) + ',' + std::to_string(b) + ',' + std::to_string(c) + ',' +
           std::to_string(d) + ']';
  };
  return '[' + text(x, x + side, x + side, x) + ',' + text(y, y, y + side, y + side) +
         ",[255,128,0]," + flags + ",[\"none\",\"none\"],[]]";
}

std::string section(const std::string& contours, const std::string& thickness = "0.05",
                    const std::string& tforms = R"({"default":[1,0,0,0,1,0]})") {
  return R"({"src":"a.tif","contours":{)" + contours + R"(},"thickness":)" + thickness +
         R"(,"tforms":)" + tforms + '}';
}

std::string list_of(const std::string& sections, const std::string& alignment = "default") {
  return R"({"sections":[)" + sections + R"(],"series":{"alignment":")" + alignment +
         R"(","palette_traces":[["p",[0],[0]]]}})";
}

double area(const Contour& contour) {
  double sum = 0;
  for (std::size_t i = 0; i < contour.points.size(); ++i) {
    const cdt::Point& a = contour.points[i];
    const cdt::Point& b = contour.points[(i + 1) % contour.points.size()];
    sum += a.x * b.y - b.x * a.y;
  }
  return sum / 2;
}

double area(const Slice& slice) {
  double sum = 0;
  for (const Contour& contour : slice.contours) sum += area(contour);
  return sum;
}

TEST(Jser, ReadsAListOfSections) {
  const Stack stack =
      read(read_jser, list_of(section("\"axon\":[" + square_trace(0, 0, 2) + "]") + ",null," +
                              section("\"axon\":[" + square_trace(0, 0, 2) + "],\"spine\":[" +
                                      square_trace(5, 0, 1) + "]")));
  EXPECT_EQ(stack.unit, "um");
  EXPECT_EQ(stack.fill, Fill::nonzero);
  EXPECT_EQ(stack.labels, (std::vector<StackLabel>{{"axon", Colour{255, 128, 0}, "", "", {}},
                                                   {"spine", Colour{255, 128, 0}, "", "", {}}}));
  ASSERT_EQ(stack.slices.size(), 2U);
  EXPECT_DOUBLE_EQ(stack.slices[0].z, 0.05);
  EXPECT_DOUBLE_EQ(stack.slices[1].z, 0.15);  // the missing one keeps its place
  EXPECT_EQ(stack.slices[1].contours[1],
            (Contour{{{5, 0}, {6, 0}, {6, 1}, {5, 1}}, "spine", "section 2 trace 0"}));
}

TEST(Jser, ReadsAMemberASection) {
  const std::string trace =
      R"({"x":[0,4,0],"y":[0,0,3],"color":[0,0,255],"closed":true,"negative":false,)"
      R"("hidden":false,"mode":["none","none"],"tags":[]})";
  const Stack stack = read(read_jser, R"({"s.v2.10":)" + section("\"d\":[" + trace + "]") +
                                          R"(,"s.v2.9":)" + section("\"d\":[" + trace + "]") +
                                          R"(,"s.v2.ser":{"sections":{"9":"s.v2.9"},)" +
                                          R"("alignment":"default"}})");
  ASSERT_EQ(stack.slices.size(), 2U);
  EXPECT_DOUBLE_EQ(stack.slices[0].z, 0.5);
  EXPECT_DOUBLE_EQ(stack.slices[1].z, 0.55);
  EXPECT_EQ(stack.slices[0].contours[0].points, (Points{{0, 0}, {4, 0}, {0, 3}}));
  EXPECT_EQ(stack.labels.at(0).colour, (Colour{0, 0, 255}));
}

TEST(Jser, ReadsAnObjectOfSections) {
  const Stack stack =
      read(read_jser, R"({"sections":{"3":)" + section("\"a\":[" + square_trace(0, 0, 1) + "]") +
                          R"(},"series":{}})");
  EXPECT_DOUBLE_EQ(stack.slices.at(0).z, 0.2);
}

TEST(Jser, SumsThicknesses) {
  const std::string contours = "\"a\":[" + square_trace(0, 0, 1) + "]";
  const Stack stack =
      read(read_jser, list_of(section(contours, "0.05") + ',' + section(contours, "0.1") +
                              ",null," + section(contours, "0.1")));
  ASSERT_EQ(stack.slices.size(), 3U);
  EXPECT_DOUBLE_EQ(stack.slices[1].z, 0.15);
  EXPECT_DOUBLE_EQ(stack.slices[2].z, 0.35);
}

TEST(Jser, PlacesTracesByAnAlignment) {
  const std::string tforms = R"({"default":[1,0,0,0,1,0],"local":[0,-2,10,2,0,20]})";
  const std::string text =
      list_of(section("\"a\":[" + square_trace(1, 0, 1) + "]", "0.05", tforms), "local");
  EXPECT_EQ(read(read_jser, text).slices.at(0).contours.at(0).points,
            (Points{{10, 22}, {10, 24}, {8, 24}, {8, 22}}));
  ReadOptions options;
  options.alignment = "default";
  EXPECT_EQ(read(read_jser, text, options).slices.at(0).contours.at(0).points[0],
            (cdt::Point{1, 0}));
  options.alignment = "no-alignment";
  EXPECT_EQ(read(read_jser, text, options).slices.at(0).contours.at(0).points[0],
            (cdt::Point{1, 0}));
  options.alignment = "globl";
  EXPECT_EQ(problem(read_jser, text, options),
            "a.file: the alignment 'globl' is missing in 1 section; there are 'default', 'local': "
            "name one by --alignment");
}

TEST(Jser, FillsTracesInOneAnother) {
  // Drawn in opposite directions: both are wound around once.
  const std::string inner = R"([[1,1,2,2],[1,2,2,1],[0,0,0],true,false,false,[],[]])";
  const Stack stack =
      read(read_jser, list_of(section("\"a\":[" + square_trace(0, 0, 4) + ',' + inner + "]")));
  ASSERT_EQ(stack.slices.at(0).contours.size(), 2U);
  EXPECT_EQ(area(stack.slices[0].contours[1]), 1);
}

TEST(Jser, TakesNegativeTracesAway) {
  const std::string negative = "true,true,false";
  // Twice under the first square; half in the union; outside of all.
  const Stack stack = read(
      read_jser, list_of(section("\"a\":[" + square_trace(0, 0, 4) + ',' + square_trace(0, 0, 3) +
                                 ',' + square_trace(1, 1, 1, negative.c_str()) + ',' +
                                 square_trace(3.5, 0, 1, negative.c_str()) + ',' +
                                 square_trace(20, 0, 1, negative.c_str()) + "],\"b\":[" +
                                 square_trace(0, 0, 1) + "]") +
                         ',' + section("\"a\":[" + square_trace(0, 0, 1, negative.c_str()) + "]")));
  ASSERT_EQ(stack.slices.size(), 1U);
  double sum = 0;
  for (const Contour& contour : stack.slices[0].contours)
    if (contour.label == "a") sum += area(contour);  // holes are clockwise
  EXPECT_DOUBLE_EQ(sum, 16 - 1 - 0.5);
  EXPECT_EQ(stack.notes.at(0), "label 'a': 1 negative trace that is alone in its section left out");
}

TEST(Jser, CountsWhatItLeavesOut) {
  const std::string contours =
      "\"a\":[" + square_trace(0, 0, 1) + ',' + square_trace(0, 0, 1, "false,false,false") + ',' +
      square_trace(0, 0, 1, "true,false,true") + ",[[1],[1],[0,0,0],true,false,false]," +
      "[[1,2],[1,2],[0,0,0],true,false,false]]";
  EXPECT_EQ(read(read_jser, list_of(section(contours))).notes.at(0),
            "label 'a': 2 contours of 1 or 2 points, 1 hidden trace, 1 open trace left out");
  EXPECT_EQ(area(read(read_jser, list_of(section(contours))).slices.at(0)), 1);
  EXPECT_NE(problem(read_jser,
                    list_of(section("\"a\":[" + square_trace(0, 0, 1, "false,false,false") + "]")))
                .find("no closed outline in it, only 1 open trace"),
            std::string::npos);
}

TEST(Jser, ListsWhatIsWrong) {
  EXPECT_EQ(
      problem(read_jser,
              list_of(section("\"a\":[[[1,2,NaN],[1,2,3]],[[1,2,3],[1,2]],7,"
                              "[[1,2,1e99],[1,2,3]]]") +
                      ',' + section("", "0") + ",{\"contours\":{}}," +
                      section("\"b\":3", "1", R"({"default":[1,0],"x":[0,0,1,0,0,1]})"))),
      "a.file: section 0: 'a' trace 0: x: NaN is not a number; write a number\n"
      "a.file: section 0: 'a' trace 1: has 3 x and 2 y\n"
      "a.file: section 0: 'a' trace 2: expected a trace, a list or an object, found a number\n"
      "a.file: section 0: 'a' trace 3: x: 1e+99 is beyond 1e+70\n"
      "a.file: section 1: its thickness is not positive; set it in PyReconstruct\n"
      "a.file: section 2: \"thickness\" is missing, or no number\n"
      "a.file: section 3: alignment 'default': a transform has 6 numbers\n"
      "a.file: section 3: alignment 'x': it leaves no area\n"
      "a.file: section 3: 'b': expected a list of traces, found a number");
  EXPECT_NE(problem(read_jser, "[1]").find("a.file: expected a series"), std::string::npos);
  EXPECT_NE(problem(read_jser, "{}").find("has no section"), std::string::npos);
  EXPECT_NE(
      problem(read_jser, "{\"sections\":[{\"thickness\"").find("a.file: byte 25: broken JSON"),
      std::string::npos);
  EXPECT_NE(problem(read_jser, std::string(100'000, '[')).find("a.file: "), std::string::npos);
  EXPECT_NE(problem(read_jser, "{\"sections\":" + std::string(100'000, '[')).find("broken JSON"),
            std::string::npos);
}

TEST(Jser, IsHurtByNoCut) {
  testing::expect_no_cut_hurts(
      read_jser, list_of(section("\"a\":[" + square_trace(0, 0, 1) + "]") + ',' +
                         section("\"a\":[" + square_trace(0, 0, 1, "true,true,false") + "]")));
}

}  // namespace
}  // namespace loft::io
