// SPDX-License-Identifier: MIT
#include "io/contours/nuages.h"

#include "tests/io/stacks/readers.h"

namespace loft::io {
namespace {

using testing::problem;

const std::string two = R"(S 3
v 7 z -0.5
{
0.1 0
4 0
0 3
}
{
1 1
2 1
2 2
1 2
}
v 0 z 0
v 3 z 0.5
{
0 0
4 0
0 3
}
)";

TEST(Nuages, ReadsSections) {
  const Stack stack = testing::read(read_nuages, two);
  ASSERT_EQ(stack.slices.size(), 3U);
  EXPECT_EQ(stack.slices[0].z, -0.5);
  ASSERT_EQ(stack.slices[0].contours.size(), 2U);
  EXPECT_EQ(stack.slices[0].contours[0],
            (Contour{{{0.1, 0}, {4, 0}, {0, 3}}, "", "section 1 contour 1"}));
  EXPECT_TRUE(stack.slices[1].contours.empty());
  EXPECT_EQ(stack.slices[2].contours.at(0).source, "section 3 contour 1");
}

TEST(Nuages, SaysWhatIsWrong) {
  EXPECT_NE(problem(read_nuages, "S 1\nv 3 z 1\n{\n0 0\n1 0\n}").find("the file ends where"),
            std::string::npos);
  EXPECT_NE(
      problem(read_nuages, "S 1\nv 2 z 1\n{\n0 0\n1 0\n2 2\n}").find("has 3 vertices instead of 2"),
      std::string::npos);
  EXPECT_NE(problem(read_nuages, "v 1").find("a.file:1: expected the letter s, found 'v'"),
            std::string::npos);
  EXPECT_NE(
      problem(read_nuages, "s 1\nv 3 z nan\n").find("a.file:2: a height: NaN is not a number"),
      std::string::npos);
  EXPECT_NE(problem(read_nuages, "s 2147483648\n").find("the file ends"), std::string::npos);
  EXPECT_NE(problem(read_nuages, two + "1").find("expected the end of the file"),
            std::string::npos);
  EXPECT_NE(problem(read_nuages, "s 0").find("no closed outline"), std::string::npos);
}

TEST(Nuages, IsHurtByNoCut) { testing::expect_no_cut_hurts(read_nuages, two); }

}  // namespace
}  // namespace loft::io
