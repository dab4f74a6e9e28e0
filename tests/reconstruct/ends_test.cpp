// SPDX-License-Identifier: MIT
// Where parts end, and what is made of little.
#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include "reconstruct/out_of_core.h"
#include "reconstruct/reconstruct.h"
#include "reconstruct/reconstruction.h"
#include "tests/reconstruct/solid.h"
#include "tests/reconstruct/stacks.h"

namespace loft {
namespace {

using stacks::square;

double volume(const Surface& surface) { return measure(surface).volume; }

/// A part in slices `from` up to `to` of seven, beside a column through all of them or alone.
std::vector<Slice> part(int from, int to, bool has_column) {
  std::vector<Slice> slices;
  for (int z = 0; z < 7; ++z) {
    Slice slice{double(z), {}};
    if (z >= from && z <= to) slice.contours.push_back(square(2));
    if (has_column) slice.contours.push_back(square(0.5, {20, 0}));
    slices.push_back(slice);
  }
  return slices;
}

TEST(Ends, OfAPartDoNotDependOnUnrelatedParts) {
  for (const Cap cap : {Cap::flat, Cap::dome, Cap::open})
    for (const auto& [from, to] :
         std::vector<std::pair<int, int>>{{2, 4}, {3, 3}, {0, 2}, {5, 6}}) {
      const Surface alone = reconstruct(part(from, to, false), {.cap = cap}).surface;
      const Surface both = reconstruct(part(from, to, true), {.cap = cap}).surface;
      const Surface column = reconstruct(part(9, 9, true), {.cap = cap}).surface;
      EXPECT_EQ(alone.n_faces() + column.n_faces(), both.n_faces()) << from << " to " << to;
      if (cap == Cap::open) continue;
      EXPECT_NEAR(volume(alone) + volume(column), volume(both), 1e-12) << from << " to " << to;
      EXPECT_TRUE(check(alone).empty());
    }
}

TEST(Ends, APartInOneSliceIsClosedAroundIt) {
  const Surface surface =
      reconstruct(std::vector<Slice>{{0, {}}, {1, {square(2)}}, {2, {}}}).surface;
  EXPECT_TRUE(check(surface).empty());
  EXPECT_GT(volume(surface), 8);
  EXPECT_LT(volume(surface), 16);
}

TEST(Ends, ALabelEndsWhereTheStackGoesOnWithoutIt) {
  std::vector<Slice> slices;
  for (int z = 0; z < 3; ++z) {
    Contour body = square(2);
    body.label = "body";
    slices.push_back({double(z), {body}});
  }
  Contour seed = square(1, {11, 1});
  seed.label = "seed";
  slices[1].contours.push_back(seed);
  EXPECT_DOUBLE_EQ(volume(reconstruct(slices, {.label = "body"}).surface), 32);
  const Surface made = reconstruct(slices, {.label = "seed"}).surface;
  EXPECT_TRUE(check(made).empty());
  EXPECT_GT(volume(made), 1);
}

TEST(Ends, EmptySlicesAtTheEndsAreNoInterruption) {
  EXPECT_TRUE(reconstruct(part(2, 4, false)).repairs.empty());
  auto apart = part(2, 4, false);
  apart[3].contours.clear();
  const auto repairs = reconstruct(apart).repairs;
  ASSERT_EQ(repairs.size(), 1U);
  EXPECT_EQ(repairs[0].kind, DefectKind::empty_slice);
}

TEST(Ends, EditsThatMakeEmptySlicesAreAsAtOnce) {
  for (const Cap cap : {Cap::flat, Cap::dome}) {
    Reconstruction live({.cap = cap});
    for (const Slice& slice : part(2, 4, false)) live.insert(slice);
    const auto expect = [&](const std::vector<Slice>& slices) {
      EXPECT_DOUBLE_EQ(live.volume(), volume(reconstruct(slices, {.cap = cap}).surface));
    };
    expect(part(2, 4, false));
    live.replace(4, Slice{4, {}});
    expect(part(2, 3, false));
    live.replace(2, Slice{2, {}});
    expect(part(3, 3, false));
    live.remove(2);
    auto slices = part(3, 3, false);
    slices.erase(slices.begin() + 2);
    expect(slices);
    live.remove(3);
    EXPECT_EQ(live.face_count(), 0U);
  }
}

std::vector<Slice> with_two_labels() {
  std::vector<Slice> slices{{0, {square(2), square(1)}}, {1, {square(2), square(1)}}};
  for (Slice& slice : slices) {
    slice.contours[0].label = "body";
    slice.contours[1].label = "organ";
  }
  return slices;
}

TEST(Labels, AreNeverMergedIntoOneSolidInSilence) {
  const auto slices = with_two_labels();
  EXPECT_THROW((void)reconstruct(slices), InputError);
  EXPECT_DOUBLE_EQ(volume(reconstruct(slices, {.label = "organ"}).surface), 4);
  EXPECT_DOUBLE_EQ(volume(reconstruct(slices, {.label = "body"}).surface), 16);

  Reconstruction live;
  EXPECT_THROW(live.insert(slices[0]), InputError);
  live.insert(Slice{0, {slices[0].contours[0]}});
  EXPECT_THROW(live.insert(Slice{1, {slices[1].contours[1]}}), InputError);
  EXPECT_EQ(live.slice_count(), 1U);
  live.replace(0, Slice{0, {slices[0].contours[1]}});  // another one, with nothing beside it
  live.insert(Slice{1, {slices[1].contours[1]}});
  EXPECT_DOUBLE_EQ(live.volume(), 4);
}

}  // namespace
}  // namespace loft
