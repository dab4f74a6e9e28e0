// SPDX-License-Identifier: MIT
#include "mesh/sections.h"

#include <gtest/gtest.h>

#include <numeric>

#include "tests/mesh/shapes.h"

namespace loft {
namespace {

double area(const std::vector<cdt::Point>& outline) {
  double twice = 0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const cdt::Point a = outline[i];
    const cdt::Point b = outline[(i + 1) % outline.size()];
    twice += a.x * b.y - a.y * b.x;
  }
  return twice / 2;
}

double area(const Section& section) {
  return std::accumulate(section.outlines.begin(), section.outlines.end(), 0.0,
                         [](double sum, const auto& outline) { return sum + area(outline); });
}

/// An octahedron of that radius.
Mesh octahedron(double r) {
  return {{{r, 0, 0}, {0, r, 0}, {-r, 0, 0}, {0, -r, 0}, {0, 0, r}, {0, 0, -r}},
          {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}, {1, 0, 5}, {2, 1, 5}, {3, 2, 5}, {0, 3, 5}}};
}

TEST(Sections, HaveTheInsideOnTheirLeft) {
  const std::vector<double> heights{0.5, -0.25, 3};
  const auto made = sections(octahedron(1), heights);
  ASSERT_EQ(made.size(), 3U);
  ASSERT_EQ(made[0].outlines.size(), 1U);
  EXPECT_DOUBLE_EQ(area(made[0]), 0.5);
  EXPECT_DOUBLE_EQ(area(made[1]), 2 * 0.75 * 0.75);
  EXPECT_TRUE(made[2].outlines.empty());
}

TEST(Sections, GoThroughVerticesInThePlane) {
  const std::vector<double> heights{0};
  const auto made = sections(octahedron(1), heights);
  ASSERT_EQ(made[0].outlines.size(), 1U);
  EXPECT_EQ(made[0].outlines[0].size(), 4U);
  EXPECT_EQ(area(made[0]), 2);
  EXPECT_EQ(made[0].open, 0U);
}

TEST(Sections, LeaveOutWhatIsOpen) {
  Mesh mesh = octahedron(1);
  mesh.faces.erase(mesh.faces.begin());
  const std::vector<double> heights{0.5, -0.5};
  const auto made = sections(mesh, heights);
  EXPECT_TRUE(made[0].outlines.empty());
  EXPECT_EQ(made[0].open, 1U);
  EXPECT_DOUBLE_EQ(area(made[1]), 0.5);
}

}  // namespace
}  // namespace loft
