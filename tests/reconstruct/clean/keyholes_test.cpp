// SPDX-License-Identifier: MIT
#include "reconstruct/clean/keyholes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/reconstruct/stacks.h"

namespace loft {
namespace {

using cdt::Point;
using Points = std::vector<Point>;

Points square(double half, Point centre = {}) { return stacks::square(half, centre).points; }

/// The outline up to its point `at`, into the hole from its point `to` all round, and back; the
/// way back is `width` above the way in.
Points keyhole(Points outline, std::size_t at, Points hole, std::size_t to, double width) {
  std::rotate(hole.begin(), hole.begin() + static_cast<std::ptrdiff_t>(to), hole.end());
  hole.push_back({hole[0].x, hole[0].y + width});
  hole.push_back({outline[at].x, outline[at].y + width});
  outline.insert(outline.begin() + static_cast<std::ptrdiff_t>(at) + 1, hole.begin(), hole.end());
  return outline;
}

double area(const Points& points, const std::vector<std::uint32_t>& ring) {
  double twice = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point a = points[ring[i]];
    const Point b = points[ring[(i + 1) % ring.size()]];
    twice += a.x * b.y - a.y * b.x;
  }
  return std::abs(twice) / 2;
}

std::vector<double> areas(const Points& points, double width) {
  std::vector<double> found;
  for (const auto& ring : cut_keyholes(points, width).rings) found.push_back(area(points, ring));
  std::ranges::sort(found);
  return found;
}

TEST(Keyholes, AreCutWhereTheChannelHasNoWidth) {
  Points hole = square(1);
  for (int turned = 0; turned < 2; ++turned) {
    const Points points = keyhole(square(3), 0, hole, 0, 0);
    EXPECT_EQ(areas(points, 0), (std::vector<double>{4, 36}));
    const KeyholeCut cut = cut_keyholes(points, 0.1);
    ASSERT_EQ(cut.channels.size(), 1U);
    EXPECT_EQ(cut.channels[0].area, 0);
    std::ranges::reverse(hole);
  }
}

TEST(Keyholes, AreCutWhereverThePolygonStarts) {
  for (const double width : {0.0, 0.01}) {
    Points points = keyhole(square(3), 0, square(1), 0, width);
    // A point in the middle of the channel, on both sides.
    points.insert(points.begin() + 1, {-2, -2});
    points.insert(points.end() - 4, {-2, -2 + width});
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto found = areas(points, 0.02);
      ASSERT_EQ(found.size(), 2U) << "start " << i;
      EXPECT_NEAR(found[0], 4, 0.04);
      EXPECT_NEAR(found[1], 36, 0.04);
      std::rotate(points.begin(), points.begin() + 1, points.end());
    }
  }
}

TEST(Keyholes, AreLeftWhereTheChannelIsWiderThanAskedFor) {
  const Points points = keyhole(square(3), 0, square(1), 0, 0.01);
  EXPECT_EQ(areas(points, 0.007).size(), 1U);  // across, it is a little more than that
  const KeyholeCut cut = cut_keyholes(points, 0.011);
  EXPECT_EQ(cut.rings.size(), 2U);
  ASSERT_EQ(cut.channels.size(), 1U);
  EXPECT_NEAR(cut.channels[0].area, 2 * 0.01, 1e-3);
}

TEST(Keyholes, KeepEveryPointThatIsNotWithinTheChannel) {
  const Points points =
      keyhole(stacks::circle(200, 3).points, 0, stacks::circle(90, 1).points, 0, 1e-4);
  const KeyholeCut cut = cut_keyholes(points, 0.05);
  ASSERT_EQ(cut.rings.size(), 2U);
  EXPECT_EQ(cut.rings[0].size() + cut.rings[1].size(), points.size());
}

TEST(Keyholes, MayHavePointsOnOneSideOfTheChannelOnly) {
  Points points = keyhole(square(3), 0, square(1), 0, 0.01);
  points.insert(points.begin() + 1, {{-2.5, -2.5}, {-2, -2}, {-1.5, -1.5}});
  EXPECT_EQ(areas(points, 0.02).size(), 2U);
}

TEST(Keyholes, MayBeSeveral) {
  // One from the outline, the next from the first hole.
  for (const double width : {0.0, 1e-6}) {
    const Points inner = keyhole(square(0.5, {-1.5, 0}), 1, square(0.5, {1.5, 0}), 0, width);
    const auto found = areas(keyhole(square(3), 0, inner, 0, width), 0.01);
    ASSERT_EQ(found.size(), 3U);
    EXPECT_NEAR(found[0], 1, 1e-5);
    EXPECT_NEAR(found[1], 1, 1e-5);
    EXPECT_NEAR(found[2], 36, 1e-5);
  }
}

/// A square with a channel upwards through its lower side, into a hole of that half width.
Points channel(double width, double half) {
  return {{-3, -3},
          {0, -3},
          {0, -1},
          {-half, -1},
          {-half, 2 * half - 1},
          {half, 2 * half - 1},
          {half, -1},
          {width, -1},
          {width, -3},
          {3, -3},
          {3, 3},
          {-3, 3}};
}

TEST(Keyholes, MayLeadToSmallHoles) {
  for (const double half : {0.3, 0.5, 1.0}) {
    const auto found = areas(channel(0.1, half), 0.1);
    ASSERT_EQ(found.size(), 2U) << half;
    EXPECT_NEAR(found[0], 4 * half * half, 1e-12);
    EXPECT_NEAR(found[1], 36, 1e-12);
  }
}

TEST(Keyholes, DoNotIncludeSlitsAndBaysThatAreHardlyWiderThanTheirMouth) {
  EXPECT_EQ(areas(channel(0.1, 0.1), 0.1).size(), 1U);
  const Points slit{{-3, -3}, {0, -3}, {0, 2}, {0.1, 2}, {0.1, -3}, {3, -3}, {3, 3}, {-3, 3}};
  EXPECT_EQ(areas(slit, 0.1).size(), 1U);
  EXPECT_EQ(areas(slit, 1).size(), 1U);
  const Points bay{{-3, -3}, {0, -3}, {0, -2}, {0.9, -2}, {0.9, -3}, {3, -3}, {3, 3}, {-3, 3}};
  EXPECT_EQ(areas(bay, 1).size(), 1U);
}

TEST(Keyholes, MayEndInSlantedOutlines) {
  Points points = channel(0.1, 1);
  points[1].y += 0.05;  // where the channel begins
  points[8].y -= 0.05;
  points[2].y += 0.04;  // where the hole begins
  points[3].y += 0.08;
  points[6].y -= 0.04;
  points[7].y -= 0.04;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const KeyholeCut cut = cut_keyholes(points, 0.1);
    ASSERT_EQ(cut.rings.size(), 2U) << "start " << i;
    EXPECT_EQ(cut.rings[0].size() + cut.rings[1].size(), points.size()) << "start " << i;
    std::rotate(points.begin(), points.begin() + 1, points.end());
  }
}

TEST(Keyholes, DoNotIncludeBridgesBetweenPartsSideBySide) {
  const Points points = keyhole(square(1), 1, square(1, {5, 0}), 0, 1e-3);
  EXPECT_EQ(areas(points, 0.01).size(), 1U);
}

TEST(Keyholes, DoNotIncludeSpikesAndTouchingCorners) {
  Points spike = square(3);
  spike.insert(spike.begin() + 1, {{0, 0}, {-3, -3}});
  EXPECT_EQ(areas(spike, 0.1).size(), 1U);
  Points pinched = square(3);
  const Points loop = square(1, {-2, -2});
  pinched.insert(pinched.begin() + 1, loop.begin(), loop.end());
  pinched.insert(pinched.begin() + 5, {-3, -3});
  EXPECT_EQ(areas(pinched, 0.1).size(), 1U);
}

TEST(Keyholes, LeaveAnOutlineWithout) {
  for (const std::size_t n : {3U, 40U, 5000U})
    EXPECT_EQ(cut_keyholes(stacks::circle(n, 1).points, 0.01).rings.size(), 1U);
}

}  // namespace
}  // namespace loft
