// SPDX-License-Identifier: MIT
// A branch that leaves at once does not overlap what it comes from, but lies beside it: it is
// joined, unless something speaks for an end.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "mesh/measure.h"
#include "tests/reconstruct/live/edit_script.h"
#include "tests/reconstruct/solid.h"
#include "tests/reconstruct/stacks.h"

namespace loft {
namespace {

using cdt::Point;

constexpr std::size_t round_corners = 40;

Contour round(double radius, Point centre) { return stacks::circle(round_corners, radius, centre); }

/// A trunk that becomes two branches, of which one is in one slice only, beside the trunk by `gap`.
/// Far from these a rod.
std::vector<Slice> fork_with_a_stub(double gap) {
  const Contour rod = round(1, {20, 1});
  const Point stub{2 + gap + 1.3, 0.4};
  return {{0, {round(2, {0, 0}), rod}},
          {2, {round(2, {0, 0}), rod}},
          {4, {round(1.6, {-1.5, 0}), round(1.3, stub), rod}},
          {6, {round(1.6, {-3, 0.2}), rod}},
          {8, {round(1.6, {-4.5, 0.4}), rod}}};
}

/// An angle with two legs, of which one becomes a branch that hardly overlaps it, and the other a
/// twig beside its end. Without the twig all of the angle would be drawn over to the branch.
std::vector<Slice> legs_that_part(double gap) {
  Contour branch = round(1, {0, 0});
  for (Point& p : branch.points) p = {3.2 * p.x - 12.5, 1.8 * p.y + 2};
  const Contour angle{.points = {{4, 4}, {-10, 4}, {-10, 0}, {0, 0}, {0, -10}, {4, -10}}};
  return {{0, {stacks::square(3, {1, 1})}},
          {4, {angle}},
          {8, {std::move(branch), round(1.6, {2, -11.6 - gap})}}};
}

Measures measures_of(const std::vector<Slice>& slices, const Options& options = {}) {
  const Reconstructed made = reconstruct(slices, options);
  EXPECT_EQ(solids::faults(made.surface), "");
  return measure(made.surface);
}

TEST(Beside, ABranchIsJoinedToTheTrunkThatItLiesBeside) {
  for (const double gap : {0.05, 0.3, 0.8, 1.2}) {
    SCOPED_TRACE(gap);
    const Measures joined = measures_of(fork_with_a_stub(gap));
    EXPECT_EQ(joined.components, 2U);  // and the rod
    EXPECT_EQ(joined.genus, 0);
    const Measures alone = measures_of(fork_with_a_stub(gap), {.link = LinkRule::overlap});
    EXPECT_EQ(alone.components, 3U);
    EXPECT_GT(joined.volume, alone.volume);
  }
}

TEST(Beside, WhatIsFartherAwayThanItsRadiusStaysAlone) {
  EXPECT_EQ(measures_of(fork_with_a_stub(1.6)).components, 3U);
}

TEST(Beside, AnEndIsJoinedToAnEndThatItLiesBeside) {
  // A branch that lies nearly flat, and its last slice, which is too far up to overlap it.
  const std::vector<Slice> slices{{0, {round(3, {0, 0}), round(1, {20, 0})}},
                                  {2, {round(2.5, {4, 0}), round(1, {20, 0})}},
                                  {4, {round(1.4, {9.5, 0.5}), round(1, {20, 0})}},
                                  {6, {round(1, {20, 0})}}};
  EXPECT_EQ(measures_of(slices).components, 2U);
}

TEST(Beside, OnTheOtherSideOfAStackItIsTheSame) {
  std::vector<Slice> slices = fork_with_a_stub(0.4);
  const Measures there = measures_of(slices);
  for (Slice& slice : slices) slice.z = -slice.z;
  std::ranges::reverse(slices);
  const Measures reversed = measures_of(slices);
  EXPECT_EQ(reversed.components, there.components);
  EXPECT_EQ(reversed.genus, there.genus);
  EXPECT_NEAR(reversed.volume, there.volume, 1e-6 * there.volume);
}

TEST(Beside, WhicheverWayAStackIsTurnedItIsTheSame) {
  for (const auto& slices : {fork_with_a_stub(0.05), fork_with_a_stub(0.6), fork_with_a_stub(1.3),
                             legs_that_part(0.3)}) {
    const Measures there = measures_of(slices);
    for (const double angle : {0.3, 1.1, 2.9, 4.4}) {
      SCOPED_TRACE(angle);
      std::vector<Slice> turned = slices;
      for (Slice& slice : turned)
        for (Contour& contour : slice.contours)
          for (Point& p : contour.points)
            p = {p.x * std::cos(angle) - p.y * std::sin(angle),
                 p.x * std::sin(angle) + p.y * std::cos(angle)};
      const Measures measured = measures_of(turned);
      EXPECT_EQ(measured.components, there.components);
      EXPECT_EQ(measured.genus, there.genus);
      EXPECT_NEAR(measured.volume, there.volume, 1e-6 * there.volume);
    }
  }
}

TEST(Beside, AFingertipBesideAFingerThatGoesOnIsNotJoinedToIt) {
  std::vector<Slice> slices;
  for (int i = 0; i < 6; ++i) {
    slices.push_back({2.0 * i, {round(1, {0, 0.05 * i})}});
    if (i < 3) slices.back().contours.push_back(round(1, {2.3, 0}));
  }
  EXPECT_EQ(measures_of(slices).components, 2U);
}

TEST(Beside, WhatIsOneBelowIsNotJoinedAgainAbove) {
  // Two fingers on one hand: the shorter one ends beside the longer one, which bends towards it.
  const Contour hand = stacks::square(4, {1.5, 0});
  const std::vector<Slice> slices{{0, {hand}},
                                  {2, {round(1, {0, 0}), round(1, {3.2, 0})}},
                                  {4, {round(1.2, {1, 0})}},
                                  {6, {round(1.2, {1.5, 0})}}};
  const Measures measured = measures_of(slices);
  EXPECT_EQ(measured.components, 1U);
  EXPECT_EQ(measured.genus, 0);
}

TEST(Beside, ATwigDoesNotKeepAWideTrunkFromEnding) {
  std::vector<Slice> slices{{0, {round(10, {0, 0})}},
                            {2, {round(10, {0, 0})}},
                            {4, {round(1.5, {11.8, 0})}},
                            {6, {round(30, {60, 0})}}};
  for (Slice& slice : slices) slice.contours.push_back(round(30, {60, 0}));
  slices.back().contours.pop_back();
  EXPECT_EQ(measures_of(slices).components, 3U);
}

TEST(Beside, BetweenTwoThatAreAsNearItIsJoinedToNone) {
  std::vector<Slice> slices;
  for (int i = 0; i < 5; ++i) {
    const double x = i < 3 ? 3 : 4;
    slices.push_back({2.0 * i, {round(1.5, {-x, 0}), round(1.5, {x, 0})}});
  }
  slices[3].contours.push_back(round(1, {0, 0}));
  EXPECT_EQ(measures_of(slices).components, 3U);
}

TEST(Beside, OrdersAndTheFarthestShiftKeepItApart) {
  const std::vector<Slice> slices = fork_with_a_stub(0.4);
  Options options;
  options.links = {{{1, 0}, {2, 1}, false}};
  EXPECT_EQ(measures_of(slices, options).components, 3U);
  EXPECT_EQ(measures_of(slices, {.max_shift = 1.0}).components, 3U);
}

TEST(Beside, ATwigIsJoinedToALegThatAnotherBranchWouldTake) {
  for (const double gap : {0.05, 0.5}) {
    SCOPED_TRACE(gap);
    const Measures joined = measures_of(legs_that_part(gap));
    EXPECT_EQ(joined.components, 1U);
    EXPECT_EQ(joined.genus, 0);
    EXPECT_GT(joined.volume, measures_of(legs_that_part(gap), {.link = LinkRule::overlap}).volume);
  }
}

TEST(Beside, EditsLeadToTheSameSurfaceAsTheWholeStack) {
  EXPECT_EQ(edits::fault_of_edits(fork_with_a_stub(0.4), 7, 12), "");
  EXPECT_EQ(edits::fault_of_edits(legs_that_part(0.3), 8, 12), "");
}

}  // namespace
}  // namespace loft
