// SPDX-License-Identifier: MIT
// Two parts side by side that move so far that one comes over where the other was stay two; one
// that divides, and whose branches overlap it no longer, stays one.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "mesh/measure.h"
#include "tests/reconstruct/live/edit_script.h"
#include "tests/reconstruct/solid.h"
#include "tests/reconstruct/stacks.h"

namespace loft {
namespace {

using cdt::Point;

constexpr std::size_t disc_corners = 40;
const double area_of_disc = disc_corners * std::sin(2 * std::numbers::pi / disc_corners) / 2;

Contour disc(Point centre) { return stacks::circle(disc_corners, 1, centre); }

/// Two discs of radius 1, 2.6 from each other, that move by `step` towards where one of them was.
std::vector<Slice> pair_of_discs(double step, int count = 4) {
  std::vector<Slice> slices;
  for (int i = 0; i < count; ++i)
    slices.push_back({1.0 * i, {disc({step * i, 0.1 * i}), disc({step * i + 2.6, 0.1 * i})}});
  return slices;
}

/// A disc that becomes two, each of which moves by `step` a slice.
std::vector<Slice> fork_of_discs(double step) {
  std::vector<Slice> slices{{0, {disc({0, 0})}}, {1, {disc({0, 0})}}};
  for (int i = 1; i < 4; ++i)
    slices.push_back({1.0 + i, {disc({-step * i, 0}), disc({step * i, 0.2 * i})}});
  return slices;
}

Reconstructed separate_solid(const std::vector<Slice>& slices) {
  Options options;
  options.reports_slabs = true;
  Reconstructed made = reconstruct(slices, options);
  EXPECT_EQ(solids::faults(made.surface), "");
  return made;
}

std::size_t count(const Reconstructed& made, LinkKind kind) {
  std::size_t sum = 0;
  for (const SlabReport& slab : made.slabs)
    sum += static_cast<std::size_t>(std::ranges::count(slab.links, kind, &LinkReport::kind));
  return sum;
}

TEST(Separate, PartsThatComeWhereOthersWereStayApart) {
  for (const double step : {0.7, 0.9, 1.1}) {
    SCOPED_TRACE(step);
    const Reconstructed made = separate_solid(pair_of_discs(step));
    const Measures measures = measure(made.surface);
    EXPECT_EQ(measures.components, 2U);
    EXPECT_EQ(measures.genus, 0);
    EXPECT_NEAR(measures.volume, 6 * area_of_disc, 1e-9);
    EXPECT_EQ(count(made, LinkKind::link), 6U);
  }
}

TEST(Separate, PartsThatOverlapAsMuchCrosswiseStayTogether) {
  const Reconstructed made = separate_solid(pair_of_discs(1.3, 2));
  EXPECT_EQ(count(made, LinkKind::tangle), 1U);
}

TEST(Separate, AnOrderKeepsThemTogether) {
  Options options;
  options.links = {{{1, 0}, {2, 1}, true}};
  std::vector<Slice> slices = pair_of_discs(-0.9);
  const Reconstructed made = reconstruct(slices, options);
  EXPECT_EQ(solids::faults(made.surface), "");
  EXPECT_EQ(measure(made.surface).components, 1U);
  EXPECT_TRUE(made.repairs.empty());
}

TEST(Separate, AnEditOfOnePartLooksAtTheOtherOne) {
  Reconstruction live;
  for (const Slice& slice : pair_of_discs(0.9, 2)) live.insert(slice);
  live.replace(0, Slice{0, {stacks::circle(disc_corners, 0.3, {-0.6, 0}), disc({2.6, 0})}});
  EXPECT_EQ(edits::difference(live, {}), "");
  EXPECT_EQ(solids::faults(live.snapshot().surface(1)), "");
}

TEST(Separate, EditsLeadToTheSameSurfaceAsTheWholeStack) {
  EXPECT_EQ(edits::fault_of_edits(pair_of_discs(1), 3, 12), "");
}

TEST(Joins, BranchesThatLeaveTheTrunkAtOnceAreJoinedToIt) {
  for (const double step : {2.05, 2.1, 2.2}) {
    SCOPED_TRACE(step);
    const Reconstructed made = separate_solid(fork_of_discs(step));
    const Measures measures = measure(made.surface);
    EXPECT_EQ(measures.components, 1U);
    EXPECT_EQ(measures.genus, 0);
    EXPECT_EQ(count(made, LinkKind::split), 1U);
  }
}

TEST(Joins, WhatDoesNotComeFromAPartIsNotJoinedToIt) {
  std::vector<Slice> slices = fork_of_discs(2.4);
  for (std::size_t i = 2; i < slices.size(); ++i)
    slices[i].contours = {disc({-1.0 * double(i), 0}), disc({2.4, 3.0 * double(i)})};
  EXPECT_EQ(measure(separate_solid(slices).surface).components, 2U);
}

TEST(Joins, AnOrderKeepsABranchFromItsTrunk) {
  Options options;
  options.links = {{{1, 0}, {2, 0}, false}};
  const Reconstructed made = reconstruct(fork_of_discs(2.1), options);
  EXPECT_EQ(solids::faults(made.surface), "");
  EXPECT_EQ(measure(made.surface).components, 2U);
  EXPECT_TRUE(made.repairs.empty());
}

TEST(Joins, EditsLeadToTheSameSurfaceAsTheWholeStack) {
  EXPECT_EQ(edits::fault_of_edits(fork_of_discs(2.2), 5, 16), "");
}

// Two holes that cross leave an island between them, which touches what goes round both: groups of
// cavities had it without that, inside out.
TEST(Separate, LeavesCavitiesThatTouchTogether) {
  const std::vector<Slice> slices{
      {0,
       {{{{102, 137}, {160, -6}, {111, -73}, {93, -85}, {-32, -100}, {-148, 55}}, ""},
        {{{-8, -88}, {13, -94}, {16, -91}}, ""},
        {{{29, 101}, {32, 98}, {35, 101}}, ""},
        {{{50, -79}, {120, -46}, {138, -27}}, ""}}},
      {10,
       {{{{120, 122}, {166, 24}, {138, -43}, {65, -94}, {-51, -97}, {-133, 91}}, ""},
        {{{-5, -82}, {-2, -91}, {1, -91}}, ""},
        {{{13, -91}, {16, -94}, {19, -91}}, ""},
        {{{26, 82}, {86, -73}, {132, -40}}, ""},
        {{{-14, -82}, {-5, -82}, {32, 107}, {29, 110}}, ""}}}};
  for (const Fill fill : {Fill::even_odd, Fill::keyhole_aware})
    EXPECT_EQ(solids::faults(reconstruct(slices, {.fill = fill}).surface), "");
}

}  // namespace
}  // namespace loft
