// SPDX-License-Identifier: MIT
#include "io/contours/csv.h"

#include "tests/io/stacks/readers.h"

namespace loft::io {
namespace {

using testing::problem;
using testing::read;
using Points = std::vector<cdt::Point>;

const Points triangle{{0, 0}, {4.5, 0}, {0, 3}};

TEST(Csv, ReadsColumnsByTheirNamesInAnyOrder) {
  const Stack stack =
      read(read_csv,
           "label,Z [mm],note,Y [mm],X [mm]\nheart,1,a,0,0\nheart,1,,0,4.5\nheart,1,b,3,0\n"
           "lung,1,,0,0\nlung,1,,0,4.5\nlung,1,,3,0\n");
  EXPECT_EQ(stack.unit, "mm");
  ASSERT_EQ(stack.slices.size(), 1U);
  ASSERT_EQ(stack.slices[0].contours.size(), 2U);
  EXPECT_EQ(stack.slices[0].contours[0], (Contour{triangle, "heart", "line 2"}));
  EXPECT_EQ(stack.slices[0].contours[1], (Contour{triangle, "lung", "line 5"}));
}

TEST(Csv, TakesAnySeparatorAndDecimalCommas) {
  for (const std::string text :
       {"x,y,z\n0,0,1.5\n4.5,0,1.5\n0,3,1.5\n", "x;y;z\n0;0;1,5\n4,5;0;1,5\n0;3;1,5\n",
        "x\ty\tz\r\n0\t0\t1,5\r\n4,5\t0\t1,5\r\n0\t3\t1,5\r\n",
        "x y z\n0 0 1.5\n4.5  0 1.5\n 0 3 1.5", "x y z\n0 0 1,5\n4,5 0 1,5\n0 3 1,5",
        "x,y,z\n0,0,\"1,5\"\n\"4,5\",0,\"1,5\"\n0,3,\"1,5\"\n",
        "# x y z\n0 0 1.5\n4.5 0 1.5\n0 3 1.5\n",
        "\xEF\xBB\xBFX, Y, Z\n0, 0, 1.5\n+4.5, 0, 1.5\n0, 3, 15e-1\n",
        "0,0,1.5\n4.5,0,1.5\n0,3,1.5\n", "0 0 1,5\n4,5 0 1,5\n0 3 1,5\n"}) {
    const Stack stack = read(read_csv, text);
    ASSERT_EQ(stack.slices.size(), 1U) << text;
    EXPECT_EQ(stack.slices[0].z, 1.5) << text;
    EXPECT_EQ(stack.slices[0].contours.at(0).points, triangle) << text;
  }
}

TEST(Csv, BeginsAContourAtABlankLineOrAChangeOfHeight) {
  const std::string corners = "0 0 1\n4 0 1\n0 3 1\n";
  const Stack stack =
      read(read_csv, "x y z\n" + corners + "\n\n" + corners + "0 0 2\n4 0 2\n0 3 2\n");
  ASSERT_EQ(stack.slices.size(), 2U);
  EXPECT_EQ(stack.slices[0].contours.size(), 2U);
  EXPECT_EQ(stack.slices[1].contours.size(), 1U);
}

TEST(Csv, FollowsTheContourColumnAcrossBlankLines) {
  const Stack stack = read(
      read_csv,
      "x;y;z;contour\n0;0;1;a\n4;0;1;a\n\n0;3;1;a\n0;0;1;b\n4;0;1;b\n0;3;1;b\n0;0;2;b\n4;0;2;b\n"
      "0;3;2;b\n");
  ASSERT_EQ(stack.slices.size(), 2U);
  EXPECT_EQ(stack.slices[0].contours.size(), 2U);
  EXPECT_EQ(stack.slices[1].contours.size(), 1U);
}

TEST(Csv, IsNotPartedByRoundingOfHeights) {
  const Stack stack =
      read(read_csv,
           "x y z\n0 0 36\n4 0 36.000003814697266\n0 3 36\n0 0 38\n4 0 38\n0 3 37.9999999\n0 0 40\n"
           "4 0 40\n0 3 40\n");
  ASSERT_EQ(stack.slices.size(), 3U);
  EXPECT_EQ(stack.slices[0].z, 36);
  EXPECT_EQ(stack.slices[1].z, 38);
}

TEST(Csv, TakesNamesOfLinesThatTheHeaderDoesNotCount) {
  const Stack stack =
      read(read_csv, "\"x\" \"y\" \"z\"\n\"1\" 0 0 1.5\n\"2\" 4.5 0 1.5\n\"3\" 0 3 1.5\n");
  EXPECT_EQ(stack.slices.at(0).z, 1.5);
  EXPECT_EQ(stack.slices[0].contours.at(0).points, triangle);
}

TEST(Csv, SaysThatItTookColumnsByOrder) {
  const Stack stack = read(read_csv, "0 0 1 7 a\n4 0 1 7 a\n0 3 1 7 a\n");
  EXPECT_EQ(stack.slices.at(0).contours.at(0).label, "a");
  EXPECT_EQ(stack.notes.at(0),
            "no header: the columns were taken as x y z contour label, in order");
}

TEST(Csv, ListsWhatIsWrong) {
  EXPECT_EQ(problem(read_csv, "x y z\n0 0 1\n4 q 1\nNaN NaN NaN\n0 3\n"),
            "a.file:3: expected a number for y, found 'q'\n"
            "a.file:4: x: NaN is not a number; contours are parted by blank lines\n"
            "a.file:4: y: NaN is not a number; contours are parted by blank lines\n"
            "a.file:4: z: NaN is not a number; contours are parted by blank lines\n"
            "a.file:5: z is missing; the line has 2 columns");
  EXPECT_EQ(problem(read_csv, "a,b,y\n1,2,3\n"),
            "a.file:1: no column 'x', 'z' in the header 'a,b,y'; name the columns x, y, z and, if "
            "there are, contour, label");
  EXPECT_NE(problem(read_csv, "1 2\n3 4\n").find("found 2 columns"), std::string::npos);
  EXPECT_NE(problem(read_csv, "").find("no point in it"), std::string::npos);
  EXPECT_NE(problem(read_csv, "#\n1 2\n").find("a.file:2: expected columns"), std::string::npos);
  EXPECT_NE(problem(read_csv, "x y z\n1 2 3\n").find("only 1 contour of 1 or 2 points"),
            std::string::npos);
  std::string many = "x y z\n";
  for (int i = 0; i < 50; ++i) many += "1 2 q\n";
  EXPECT_NE(problem(read_csv, many).find("a.file: and 30 more"), std::string::npos);
}

TEST(Csv, IsHurtByNoCut) {
  testing::expect_no_cut_hurts(read_csv,
                               "x;y;z;contour;label\n0;0;1,5;a;b\n4,5;0;1,5;a;b\n"
                               "0;\"3\";1,5;a;b\n\n0;0;2;c;d\n");
}

}  // namespace
}  // namespace loft::io
