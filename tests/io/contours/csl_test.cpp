// SPDX-License-Identifier: MIT
#include "io/contours/csl.h"

#include "tests/io/stacks/readers.h"

namespace loft::io {
namespace {

using testing::problem;
using testing::read;
using Points = std::vector<cdt::Point>;

/// Two planes; in the first a square with a hole whose material is that of outside.
const std::string csl = R"(CSLC
2 2

1 7 2 0 0 1 -1.5

0 0 1.5
6 0 1.5
6 6 1.5
0 6 1.5
1 1 1.5
2 1 1.5
1 2 1.5

4 1 0 1 2 3
3h0 2 4 5 6

2 3 1 0 0 1 -2.5

0.1 0 2.5
6 0 2.5
6 6 2.5

3 1 0 1 2
)";

TEST(Csl, ReadsPlanesAndHoles) {
  const Stack stack = read(read_csl, csl);
  ASSERT_EQ(stack.slices.size(), 2U);
  EXPECT_EQ(stack.slices[0].z, 1.5);
  EXPECT_EQ(stack.fill, Fill::even_odd);
  ASSERT_EQ(stack.slices[0].contours.size(), 2U);  // one material, no label
  EXPECT_EQ(stack.slices[0].contours[1],
            (Contour{Points{{1, 1}, {2, 1}, {1, 2}}, "", "plane 1 contour 2"}));
  EXPECT_EQ(stack.slices[1].contours[0].points[0], (cdt::Point{0.1, 0}));
  EXPECT_FALSE(stack.frame);
}

TEST(Csl, TakesMaterialsAsLabels) {
  const std::string plane = "1 3 2 0 0 1 0\n0 0 0\n1 0 0\n0 1 0\n3 1 0 1 2\n3 4 2 1 0\n";
  const Stack stack = read(read_csl, "CSLC\n1 5\n" + plane);
  EXPECT_EQ(testing::labels_in(stack.slices.at(0)),
            (std::vector<std::string>{"material 1", "material 4"}));
  EXPECT_EQ(stack.labels.at(1).id, "4");
}

TEST(Csl, ChangesTheAxesOfPlanesAcrossOne) {
  const Stack stack = read(read_csl,
                           "CSLC 2 2 1 3 1 0 -1 0 7\n0 7 0\n1 7 0\n1 7 2\n3 1 0 1 2\n"
                           "2 3 1 0 1 0 -8\n0 8 0\n1 8 0\n1 8 2\n3 1 0 1 2\n");
  ASSERT_EQ(stack.slices.size(), 2U);
  EXPECT_EQ(stack.slices[0].z, 7);
  const Contour& contour = stack.slices[1].contours.at(0);
  EXPECT_TRUE(contour.places.empty());
  ASSERT_TRUE(stack.frame);
  EXPECT_EQ(stack.frame->determinant(), 1);
  EXPECT_EQ(stack.frame->at({contour.points[2].x, contour.points[2].y, 8}), (Vec3{1, 8, 2}));
}

TEST(Csl, TurnsTiltedPlanesAndKeepsTheirPoints) {
  // Planes of normal (3, 0, 4) / 5.
  const Stack stack = read(read_csl,
                           "CSLC 2 2 1 3 1 3 0 4 0\n0 0 0\n4 0 -3\n0 1 0\n3 1 0 1 2\n"
                           "2 3 1 0.6 0 0.8 -5\n3 0 4\n7 0 1\n3 1 4\n3 1 0 1 2\n");
  ASSERT_EQ(stack.slices.size(), 2U);
  EXPECT_NEAR(stack.slices[1].z, 5, 1e-12);
  ASSERT_TRUE(stack.frame);
  EXPECT_TRUE(fault(*stack.frame).empty());
  EXPECT_NEAR(stack.frame->determinant(), 1, 1e-12);
  const Contour& contour = stack.slices[1].contours.at(0);
  EXPECT_EQ(contour.places, (std::vector<Vec3>{{3, 0, 4}, {7, 0, 1}, {3, 1, 4}}));
  const Vec3 place = stack.frame->at({contour.points[1].x, contour.points[1].y, stack.slices[1].z});
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(place[i], contour.places[1][i], 1e-12);
}

TEST(Csl, RefusesPlanesThatAreNotParallelWithTheWorstAngle) {
  const std::string rest = " 0\n0 0 0\n1 0 0\n0 1 0\n3 1 0 1 2\n";
  EXPECT_EQ(
      problem(read_csl,
              "CSLC 3 2 1 3 1 0 0 1" + rest + "2 3 1 0 3 4" + rest + "3 3 1 0 1 0" + rest),
      "a.file: its planes are not parallel: 2 of 3; plane 3 most, by 90 degrees against plane "
      "1; a stack has parallel slices: keep those of one direction");
}

TEST(Csl, NamesThePlaneThatIsNotParallelToMostAlsoIfItIsTheFirst) {
  const std::string rest = " 0\n0 0 0\n1 0 0\n0 1 0\n3 1 0 1 2\n";
  const std::string turned = " 3 1 0 3 4" + rest;
  const std::string straight = " 3 1 0 0 1" + rest;
  EXPECT_EQ(problem(read_csl, "CSLC 3 2 1" + turned + '2' + straight + '3' + straight),
            "a.file: its planes are not parallel: 1 of 3; plane 1 most, by 36.9 degrees against "
            "plane 2; a stack has parallel slices: keep those of one direction");
}

TEST(Csl, KeepsEmptyPlanesWhicheverSignTheirOffsetsHave) {
  for (const std::string sign : {"", "-"}) {
    const auto plane = [&](const std::string& z, const std::string& normal, bool is_turned) {
      return "1 3 1 " + normal + (is_turned == sign.empty() ? " -" : " ") + z + "\n0 0 " + z +
             "\n1 0 " + z + "\n0 1 " + z + "\n3 1 0 1 2\n";
    };
    const Stack stack =
        read(read_csl, "CSLC 4 2\n" + plane("1", "0 0 1", false) + "2 0 0 0 0 2 " + sign + "4\n" +
                           plane("3", "0 0 -1", true) + plane("4", "0 0 1", false));
    ASSERT_EQ(stack.slices.size(), 4U) << sign;
    EXPECT_EQ(stack.slices[1].z, 2);
    EXPECT_TRUE(stack.slices[1].contours.empty());
  }
}

TEST(Csl, LeavesOutContoursOffTheirPlane) {
  const Stack stack = read(read_csl,
                           "CSLC 3 2 1 3 1 0 0 1 0\n0 0 0\n1 0 0\n0 1 0\n3 1 0 1 2\n"
                           "2 3 1 0 0 1 0\n0 0 1\n1 0 1\n0 1 1\n3 1 0 1 2\n"
                           "3 3 1 0 0 1 0\n0 0 2\n1 0 2\n0 1 2.5\n3 1 0 1 2\n");
  EXPECT_EQ(stack.slices.size(), 2U);
  EXPECT_EQ(stack.notes.at(0), "1 contour that is in no plane left out");
}

TEST(Csl, SaysWhatIsWrong) {
  EXPECT_NE(problem(read_csl, "CSL 1").find("a.file:1: expected 'CSLC', found 'CSL'"),
            std::string::npos);
  EXPECT_NE(problem(read_csl, "CSLC 2147483648 2").find("more than the file has room for"),
            std::string::npos);
  EXPECT_NE(problem(read_csl, "CSLC 1 2\n1 3 1 0 0 0 0").find("which has no direction"),
            std::string::npos);
  EXPECT_EQ(problem(read_csl, "CSLC 1 2\n1 2 1 0 0 1 0\n0 nan 0\n0 q 0\n3 1 0"),
            "a.file:3: a coordinate: NaN is not a number\n"
            "a.file:4: expected a coordinate, found 'q'\n"
            "a.file:5: the file ends where the number of a vertex should be");
  EXPECT_NE(problem(read_csl, "CSLC 1 2\n1 1 1 0 0 1 0\n0 0 0\n3 1 0 1 2")
                .find("vertex '1' is none of the plane's 1"),
            std::string::npos);
  EXPECT_NE(problem(read_csl, "CSLC 1 2\n1 1 1 0 0 1 0\n0 0 0\n3h7 1 0 0 0")
                .find("a hole is in component 7"),
            std::string::npos);
}

TEST(Csl, IsHurtByNoCut) { testing::expect_no_cut_hurts(read_csl, csl); }

/// A triangle, and a line that ends beside it.
const std::string contour_file = R"(1
0 0 1 -3
5 5
0 0 3
2 0 3
0 2 3
-1 -1 3
-2 -1 3
0 1 1 0
1 2 1 0
2 0 1 0
0 3 1 0
3 4 1 0
)";

TEST(ContourFile, JoinsTheBoundaryOfEachMaterial) {
  const std::string text = R"(2
0 0 1 -3
6 7
0 0 3
2 0 3
4 0 3
4 4 3
2 4 3
0 4 3
0 1 1 0
1 2 2 0
2 3 2 0
3 4 2 0
4 5 1 0
5 0 1 0
1 4 2 1
0 0 -1 4
3 3
0 0 4
1 0 4
0 1 4
0 1 0 1
1 2 0 1
2 0 0 1
)";
  const Stack stack = read(read_contour, text);
  ASSERT_EQ(stack.slices.size(), 2U);
  EXPECT_EQ(stack.slices[0].z, 3);
  ASSERT_EQ(stack.slices[0].contours.size(), 2U);
  EXPECT_EQ(stack.slices[0].contours[0],
            (Contour{Points{{0, 0}, {2, 0}, {2, 4}, {0, 4}}, "material 1", "plane 1 contour 1"}));
  EXPECT_EQ(stack.slices[0].contours[1].points, (Points{{2, 0}, {4, 0}, {4, 4}, {2, 4}}));
  EXPECT_EQ(stack.slices[0].contours[1].label, "material 2");
  EXPECT_EQ(stack.slices[1].z, 4);
}

TEST(ContourFile, CountsLinesThatEnd) {
  const Stack stack = read(read_contour, contour_file);
  EXPECT_EQ(stack.notes.at(0), "1 open line left out");
}

TEST(ContourFile, RefusesPlanesThatAreNotParallel) {
  const std::string rest = " 0\n3 3\n0 0 0\n1 0 0\n0 0 0\n0 1 1 0\n1 2 1 0\n2 0 1 0\n";
  EXPECT_NE(
      problem(read_contour, "2\n0 0 1" + rest + "0 1 0" + rest).find("plane 2 most, by 90 degrees"),
      std::string::npos);
}

TEST(ContourFile, SaysWhatIsWrong) {
  EXPECT_NE(problem(read_contour, "x").find("a.file:1: expected a count of planes, found 'x'"),
            std::string::npos);
  EXPECT_NE(problem(read_contour, "1\n0 0 1 0\n2147483648 1").find("more than the file has room"),
            std::string::npos);
  EXPECT_NE(problem(read_contour, "1\n0 0 1 0\n1 1\n0 0 0\n0 0 0 1\n7")
                .find("expected the end of the file, found '7'"),
            std::string::npos);
  EXPECT_NE(problem(read_contour, "0").find("no plane in it"), std::string::npos);
}

TEST(ContourFile, IsHurtByNoCut) { testing::expect_no_cut_hurts(read_contour, contour_file); }

}  // namespace
}  // namespace loft::io
