// SPDX-License-Identifier: MIT
// The tip of a part that ends between slices lies on the axis that the slices before suggest.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "mesh/measure.h"
#include "tests/reconstruct/live/edit_script.h"
#include "tests/reconstruct/solid.h"
#include "tests/reconstruct/stacks.h"

namespace loft {
namespace {

using cdt::Point;

constexpr std::size_t circle_corners = 48;
constexpr int last = 3;  // the last slice of a tube; the first is 1
constexpr double tight = 1e-9;

/// A tube of radius 1 through the slices 1 to 3 of 0 to 4, whose axis goes through the origin.
std::vector<Slice> tube(Point step, Point from = {}) {
  std::vector<Slice> slices;
  for (int i = 0; i <= last + 1; ++i) {
    slices.push_back({1.0 * i, {}});
    if (i >= 1 && i <= last)
      slices.back().contours.push_back(
          stacks::circle(circle_corners, 1, {from.x + i * step.x, from.y + i * step.y}));
  }
  return slices;
}

void add(std::vector<Slice>& slices, const std::vector<Slice>& more) {
  for (std::size_t i = 0; i < slices.size(); ++i)
    for (const Contour& contour : more[i].contours) slices[i].contours.push_back(contour);
}

/// The highest vertex above a height, of those on one side of x = 0 if that is asked for.
Vec3 tip(const Surface& surface, double above = last, double side = 0) {
  Vec3 highest{0, 0, above};
  for (const auto v : surface.vertices()) {
    const auto p = surface.point(v);
    if (p[2] > highest[2] && p[2] < last + 1 && p[0] * side >= 0) highest = {p[0], p[1], p[2]};
  }
  return highest;
}

Surface made_solid(const std::vector<Slice>& slices, const Options& options = {}) {
  Surface surface = reconstruct(slices, options).surface;
  EXPECT_EQ(solids::faults(surface), "");
  return surface;
}

std::vector<Vec3> places(const Surface& surface) {
  std::vector<Vec3> all;
  for (const auto v : surface.vertices()) {
    const auto p = surface.point(v);
    all.push_back({p[0], p[1], p[2]});
  }
  return all;
}

/// As it is if nothing moves by itself.
std::vector<Vec3> upright_places(const std::vector<Slice>& slices) {
  return places(made_solid(slices, {.link = LinkRule::overlap}));
}

TEST(Lean, TheTipOfASlantedTubeLiesOnItsAxis) {
  for (const bool is_smooth : {false, true})
    for (const Point step : {Point{0.3, 0.1}, Point{-0.8, 0.2}, Point{1.4, 0}, Point{0, -2.5}}) {
      SCOPED_TRACE(std::to_string(step.x) + (is_smooth ? ", smooth" : ""));
      const Surface surface = made_solid(tube(step), {.smooth = is_smooth});
      const Vec3 top = tip(surface);
      const double tolerance = is_smooth ? 0.02 : tight;  // steps of the bending are not exact
      EXPECT_GT(top[2], last + 0.3);
      EXPECT_NEAR(top[0], step.x * top[2], tolerance);
      EXPECT_NEAR(top[1], step.y * top[2], tolerance);
      Vec3 bottom = top;
      for (const Vec3& p : places(surface))
        if (p[2] < bottom[2]) bottom = p;
      EXPECT_NEAR(bottom[0], step.x * bottom[2], tolerance);
      EXPECT_NEAR(bottom[1], step.y * bottom[2], tolerance);
    }
}

TEST(Lean, DoesNotChangeHeights) {
  const std::vector<Slice> slices = tube({0.8, 0.2});
  const Surface leaning = made_solid(slices);
  const Surface upright = made_solid(slices, {.link = LinkRule::overlap});
  EXPECT_EQ(tip(leaning)[2], tip(upright)[2]);
  EXPECT_NE(tip(leaning)[0], tip(upright)[0]);
}

TEST(Lean, UprightAndAllButUprightTubesStayAsTheyAre) {
  for (const double step : {0.0, 0.02}) {
    const std::vector<Slice> slices = tube({step, 0});
    EXPECT_EQ(places(made_solid(slices)), upright_places(slices));
  }
}

TEST(Lean, WhatShrinksAtOneSideGoesNowhere) {
  std::vector<Slice> slices;
  for (int i = 0; i < last; ++i) slices.push_back({1.0 * i, {stacks::square(2)}});
  slices.push_back({last, {stacks::square(0.5, {1.5, 0})}});
  slices.push_back({last + 1, {}});
  EXPECT_EQ(places(made_solid(slices)), upright_places(slices));
}

TEST(Lean, IsSmallerWhereItWouldMeetSomething) {
  constexpr double step = 1.5;
  std::vector<Slice> slices = tube({step, 0});
  for (Slice& slice : slices)  // 0.1 beside the last disc
    slice.contours.push_back(stacks::square(0.5, {step * last + 1.6, 0}));
  const Surface surface = made_solid(slices);
  EXPECT_EQ(measure(surface).components, 2U);
  const Vec3 top = tip(surface);
  EXPECT_NEAR(top[0], step * last + step / 2 * (top[2] - last), tight);
}

TEST(Lean, TipsThatWouldMeetEachOtherBothLeanLess) {
  std::vector<Slice> slices = tube({1.5, 0}, {-1.5 * last - 1.1, 0});
  add(slices, tube({-1.5, 0}, {1.5 * last + 1.1, 0}));
  const Surface surface = made_solid(slices);
  EXPECT_EQ(measure(surface).components, 2U);
  const Vec3 left = tip(surface, last, -1);
  const Vec3 right = tip(surface, last, 1);
  EXPECT_NEAR(left[0], -1.1 + 0.75 * (left[2] - last), tight);
  EXPECT_NEAR(right[0], -left[0], tight);
}

TEST(Lean, CavitiesLeanAsParts) {
  constexpr double step = 0.7;
  std::vector<Slice> slices = tube({step, 0});
  for (Slice& slice : slices) slice.contours.push_back(stacks::square(6));
  const Surface surface = made_solid(slices);
  const Vec3 top = tip(surface);
  EXPECT_GT(top[2], last + 0.3);
  EXPECT_NEAR(top[0], step * top[2], tight);
}

TEST(Lean, NoneIsFurtherThanAPartWasSeenToGo) {
  std::vector<Slice> slices = tube({0.5, 0});
  for (int i = 0; i <= last; ++i) slices[static_cast<std::size_t>(i)].z = last + 0.1 * (i - last);
  const Surface surface = made_solid(slices);
  const Vec3 top = tip(surface);
  EXPECT_GT(top[0], last * 0.5);
  EXPECT_LE(top[0], last * 0.5 + 0.5 + tight);
}

TEST(Lean, EditsOfTheSliceBeforeGiveWhatIsBuiltAtOnce) {
  for (const bool is_smooth : {false, true}) {
    const Options options{.smooth = is_smooth};
    Reconstruction live(options);
    const std::vector<Slice> slices = tube({0.8, 0.2});
    for (const Slice& slice : slices) live.insert(slice);
    const auto expect_same = [&] { EXPECT_EQ(edits::difference(live, options), ""); };
    expect_same();
    for (const Point step : {Point{0, 0}, Point{0.5, -0.3}, Point{0.8, 0.2}}) {
      const Point p{last * 0.8 - step.x, last * 0.2 - step.y};
      live.replace(last - 1, {last - 1, {stacks::circle(circle_corners, 1, p)}});
      expect_same();
    }
    live.remove(last - 1);
    expect_same();
    live.insert(slices[last - 1]);
    expect_same();
  }
}

/// Nine tubes in a grid, that lean by that share of what they do in all, all ways; only the first
/// where that is 0. And an upright column that goes through.
std::vector<Slice> tubes(double share) {
  std::vector<Slice> slices = tube({0.2, 0.1}, {-9, 28});
  for (std::size_t i = 0; i < slices.size(); ++i)
    slices[i].contours.push_back(stacks::square(1, {0, -40}));
  for (int i = 1; i < 9; ++i) {
    const double x = i % 3 - 1;
    const double y = i / 3 - 1;
    add(slices, tube({0.4 * x * share, 0.3 * y * share}, {9 * x, 12 * y + 40}));
  }
  return slices;
}

TEST(Lean, RandomEditsGiveWhatIsBuiltAtOnce) {
  for (const std::uint64_t seed : {1U, 2U}) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    EXPECT_EQ(edits::fault_of_edits(tubes(1), seed, 16), "");
  }
}

TEST(Lean, AnEditBesideLeavesTheTilesOfOthers) {
  Reconstruction live;
  std::vector<Slice> slices = tubes(0);
  slices.insert(slices.begin(), {-1, {stacks::square(1, {0, -40})}});
  slices.push_back({last + 2, {stacks::square(1, {0, -40})}});
  for (const Slice& slice : slices) live.insert(slice);
  Slice& edited = slices[last + 1];
  for (Contour& contour : edited.contours)
    if (contour.points.size() == 4) contour = stacks::square(0.9, {0, -40});
  const SurfaceChange change = live.replace(last, edited);
  EXPECT_LT(change.faces_removed, live.face_count() / 9);
  EXPECT_EQ(edits::difference(live, {}), "");
}

}  // namespace
}  // namespace loft
