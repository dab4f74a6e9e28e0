// SPDX-License-Identifier: MIT
#include "reconstruct/tile/sheet_heights.h"

#include <gtest/gtest.h>

#include <vector>

#include "mesh/measure.h"
#include "reconstruct/reconstruct.h"
#include "tests/reconstruct/solid.h"

namespace loft {
namespace {

/// Two triangles, the upper one with three points that lie, but for rounding, on a side of the
/// lower one.
std::vector<Slice> flush_side(const Contour& lower, const Contour& upper) {
  return {{0, {lower}}, {1, {upper}}};
}

TEST(SheetHeights, OnAnEdgeOfBothSlicesAreHalfWay) {
  // A chord of a hair-thin sheet has its middle on both: their distances are 0.
  const std::vector<std::vector<Slice>> stacks{
      flush_side({{{2.1, -2.1}, {6.9, -1.5}, {2.3, 2.7}}, {}},
                 {{{2.9, -2.0}, {5.3, -1.7}, {6.1, -1.6}, {5.1, 0.7}}, {}}),
      flush_side({{{5.0, -3.2}, {8.0, 1.0}, {3.5, 3.5}}, {}},
                 {{{6.5, -1.1}, {7.0, -0.4}, {7.5, 0.3}, {5.6, 2.1}}, {}})};
  const double least[] = {3.88, 2.23};  // areas of the smaller and of the larger outline
  const double most[] = {11.46, 13.2};
  for (std::size_t i = 0; i < stacks.size(); ++i) {
    const Surface surface = reconstruct(stacks[i]).surface;
    EXPECT_EQ(solids::faults(surface), "");
    const Measures measures = measure(to_mesh(surface));
    EXPECT_EQ(measures.components, 1U);
    EXPECT_EQ(measures.genus, 0);
    EXPECT_GE(measures.volume, least[i]);
    EXPECT_LE(measures.volume, most[i]);
  }
}

}  // namespace
}  // namespace loft
