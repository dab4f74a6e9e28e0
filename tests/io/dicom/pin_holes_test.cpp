// SPDX-License-Identifier: MIT
#include "io/dicom/pin_holes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>
#include <utility>

#include "tests/io/stacks/pixel_centre_outlines.h"
#include "tests/io/volumes/masks.h"

namespace loft::io {
namespace {

using Pixels = std::vector<std::pair<int, int>>;
using Contours = std::vector<SpaceContour>;

constexpr double pitch = 3.04687595367432;

/// The centre of a pixel, in decimals.
Vec3 place(std::pair<int, int> pixel, double z) {
  const auto decimals = [](double value) { return std::round(value * 1e9) / 1e9; };
  return {decimals(193.096 - pitch * pixel.first), decimals(216.4 - pitch * pixel.second), z};
}

SpaceContour contour(const Pixels& pixels, const std::string& source = "a", double z = -340.25) {
  SpaceContour result{{}, "organ", source};
  for (const auto& pixel : pixels) result.points.push_back(place(pixel, z));
  return result;
}

/// What contours enclose if those around holes turn the other way, in pixels.
double area(const Contours& contours) {
  double sum = 0;
  for (const SpaceContour& contour : contours) {
    std::vector<cdt::Point> points;
    for (const Vec3& point : contour.points) points.push_back({point[0] / pitch, point[1] / pitch});
    sum += testing::area(points);
  }
  return std::abs(sum);
}

std::vector<std::vector<Vec3>> points_of(const Contours& contours) {
  std::vector<std::vector<Vec3>> result;
  for (const SpaceContour& contour : contours) result.push_back(contour.points);
  return result;
}

/// A square of 20 with a hole of 9 by 5, and a channel of that width and length to it from x on.
Pixels ring(int x, int width, int length = 8) {
  return {{0, 0},         {x, 0},   {x, length},  {6, length},
          {6, 13},        {15, 13}, {15, length}, {x + width, length},
          {x + width, 0}, {20, 0},  {20, 20},     {0, 20}};
}

/// The same without the channel.
Contours closed(int x, int width) {
  return {contour({{0, 0}, {x, 0}, {x + width, 0}, {20, 0}, {20, 20}, {0, 20}}),
          contour({{x, 8}, {6, 8}, {6, 13}, {15, 13}, {15, 8}, {x + width, 8}})};
}

TEST(PinHoles, LeaveAnOutlineAndAHoleWithAllOtherPoints) {
  Contours contours{contour(ring(8, 4))};
  const PinHoles result = close_pin_holes(contours);
  EXPECT_EQ(result.count, 1U);
  EXPECT_NEAR(result.width, 4 * pitch, 1e-6);
  EXPECT_EQ(points_of(contours), points_of(closed(8, 4)));
  for (const SpaceContour& each : contours) {
    EXPECT_EQ(each.label, "organ");
    EXPECT_EQ(each.source, "a");
  }
}

TEST(PinHoles, DoNotDependOnDirectionAndStart) {
  for (const bool is_turned : {false, true}) {
    Pixels pixels = ring(8, 4);
    if (is_turned) std::ranges::reverse(pixels);
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      std::rotate(pixels.begin(), pixels.begin() + 1, pixels.end());
      Contours contours{contour(pixels)};
      EXPECT_EQ(close_pin_holes(contours).count, 1U);
      ASSERT_EQ(contours.size(), 2U);
      EXPECT_NEAR(area(contours), 400 - 45, 1e-6);
    }
  }
}

TEST(PinHoles, AreFourPixelsWideOrSeveralLinesOfThem) {
  for (int width = 2; width <= 8; ++width) {
    const Contours drawn{contour(ring(6, width))};
    Contours contours = drawn;
    // Eight long, which is enough for one line, and for two that share most pixels.
    const bool is_channel = width == 4 || width == 5;
    EXPECT_EQ(close_pin_holes(contours).count, is_channel ? 1U : 0U) << width;
    EXPECT_EQ(points_of(contours).size(), is_channel ? 2U : 1U) << width;
    if (!is_channel) {
      EXPECT_EQ(points_of(contours), points_of(drawn)) << width;
    }
  }
}

TEST(PinHoles, AreLongerThanWide) {
  for (int length = 3; length < 8; ++length) {
    Contours contours{contour(ring(8, 4, length))};
    EXPECT_EQ(close_pin_holes(contours).count, length > 4 ? 1U : 0U) << length;
  }
}

TEST(PinHoles, RunAlongYOnly) {
  Pixels pixels = ring(8, 4);
  for (auto& [x, y] : pixels) std::swap(x, y);
  Contours contours{contour(pixels)};
  EXPECT_EQ(close_pin_holes(contours).count, 0U);
}

TEST(PinHoles, AreOutside) {
  // Two squares, and a bridge between them that is as wide as a channel.
  Contours bridge{contour({{0, 0},
                           {20, 0},
                           {20, 9},
                           {12, 9},
                           {12, 20},
                           {20, 20},
                           {20, 29},
                           {0, 29},
                           {0, 20},
                           {8, 20},
                           {8, 9},
                           {0, 9},
                           {-1, 5}})};
  EXPECT_EQ(close_pin_holes(bridge).count, 0U);
}

TEST(PinHoles, AreNoHolesThatAreLongAndNarrow) {
  const Pixels outline{{0, 0}, {21, 0}, {21, 30}, {0, 30}};
  const auto count = [&](const Pixels& hole) {
    Contours contours{contour(outline), contour(hole)};
    return close_pin_holes(contours).count;
  };
  EXPECT_EQ(count({{8, 6}, {8, 16}, {12, 16}, {12, 6}}), 0U);
  EXPECT_EQ(count({{8, 6}, {8, 16}, {10, 18}, {12, 16}, {12, 6}, {10, 4}}), 0U);
  // But such may lead from hole to hole.
  EXPECT_EQ(count({{8, 6},
                   {8, 16},
                   {6, 16},
                   {6, 20},
                   {14, 20},
                   {14, 16},
                   {12, 16},
                   {12, 6},
                   {14, 6},
                   {14, 2},
                   {6, 2},
                   {6, 6}}),
            1U);
}

TEST(PinHoles, HaveNothingBetweenTheirSides) {
  Contours contours{contour(ring(8, 4)), contour({{10, 2}, {10, 3}, {9, 3}})};
  EXPECT_EQ(close_pin_holes(contours).count, 0U);
  // Elsewhere, and in another slice, it may be.
  contours[1] = contour({{3, 2}, {3, 3}, {2, 3}}, "b");
  contours.push_back(contour({{10, 2}, {10, 3}, {9, 3}}, "c", -330.25));
  EXPECT_EQ(close_pin_holes(contours).count, 1U);
  ASSERT_EQ(contours.size(), 4U);
  EXPECT_EQ(contours[0].source, "b");
  EXPECT_EQ(contours[1].source, "c");
}

TEST(PinHoles, ToOneHoleJoinWhatTheyCutOff) {
  // Channels from x 4 to 8 and 12 to 16, and between them what is above the hole.
  Contours contours{
      contour({{0, 0}, {4, 0}, {4, 13}, {16, 13}, {16, 0}, {21, 0}, {21, 21}, {0, 21}}),
      contour({{8, 0}, {12, 0}, {12, 8}, {8, 8}})};
  EXPECT_EQ(close_pin_holes(contours).count, 2U);
  ASSERT_EQ(contours.size(), 2U);
  EXPECT_NEAR(area(contours), 21 * 21 - 12 * 5, 1e-6);
}

TEST(PinHoles, EndStraightAcrossWhereASideGoesOn) {
  // The left side goes on along the hole, by ten.
  Contours contours{contour(
      {{0, 0}, {4, 0}, {4, 18}, {15, 18}, {15, 8}, {8, 8}, {8, 0}, {20, 0}, {20, 20}, {0, 20}})};
  EXPECT_EQ(close_pin_holes(contours).count, 1U);
  ASSERT_EQ(contours.size(), 2U);
  EXPECT_EQ(contours[1].points, contour({{4, 18}, {15, 18}, {15, 8}, {8, 8}, {4, 8}}).points);
  EXPECT_NEAR(area(contours), 400 - 110, 1e-6);
}

TEST(PinHoles, GoPastHoles) {
  // The left side is one; the right side opens into a hole on the way to another one.
  Contours contours{contour({{0, 0},
                             {4, 0},
                             {4, 30},
                             {2, 30},
                             {2, 36},
                             {12, 36},
                             {12, 30},
                             {8, 30},
                             {8, 24},
                             {15, 24},
                             {15, 13},
                             {8, 13},
                             {8, 0},
                             {40, 0},
                             {40, 40},
                             {0, 40}})};
  EXPECT_EQ(close_pin_holes(contours).count, 2U);
  EXPECT_EQ(contours.size(), 3U);
  EXPECT_NEAR(area(contours), 1600 - 11 * 11 - 10 * 6, 1e-6);
}

TEST(PinHoles, MayHaveARowOfPixelsForASide) {
  Contours contours{contour({{12, 0}, {12, 21}, {31, 21}, {31, 0}}), contour({{8, 0}, {8, 9}})};
  EXPECT_EQ(close_pin_holes(contours).count, 1U);
  EXPECT_EQ(contours.size(), 1U);
  EXPECT_NEAR(area(contours), 19 * 21 + 4 * 9, 1e-6);
}

/// The pixels that contours go through or enclose, by the even-odd rule.
testing::Mask pixels_of(const Contours& contours, int size) {
  std::vector<std::vector<testing::Pixel>> outlines;
  for (const SpaceContour& each : contours) {
    auto& outline = outlines.emplace_back();
    for (const Vec3& p : each.points)
      outline.push_back({static_cast<int>(std::lround((193.096 - p[0]) / pitch)),
                         static_cast<int>(std::lround((216.4 - p[1]) / pitch))});
  }
  testing::Mask result;
  for (int x = 0; x < size; ++x)
    for (int y = 0; y < size; ++y) {
      bool is_in = false;
      bool is_on = false;
      for (const auto& outline : outlines)
        for (std::size_t i = 0; i < outline.size(); ++i) {
          const auto& [ax, ay] = outline[i];
          const auto& [bx, by] = outline[(i + 1) % outline.size()];
          const int turn = (bx - ax) * (y - ay) - (by - ay) * (x - ax);
          is_on = is_on || (turn == 0 && std::min(ax, bx) <= x && x <= std::max(ax, bx) &&
                            std::min(ay, by) <= y && y <= std::max(ay, by));
          if ((ay > y) != (by > y) && (turn > 0) == (by > ay)) is_in = !is_in;
        }
      if (is_in || is_on) result.insert({x, y});
    }
  return result;
}

TEST(PinHoles, ClosedGiveTheMaskBackButForTheEndsOfLines) {
  constexpr int size = 48;
  std::mt19937 random(7);  // the same ones each time: some would look like lines themselves
  const auto any = [&](int low, int high) {
    return low + static_cast<int>(random() % static_cast<unsigned>(high - low + 1));
  };
  for (int round = 0; round < 50; ++round) {
    // A mask with holes of any shape, far enough apart.
    testing::Mask mask;
    for (int x = 1; x < size - 1; ++x)
      for (int y = 2; y < size - 1; ++y) mask.insert({x, y});
    const testing::Mask body = mask;
    for (int left = 5; left + 12 < size; left += 14)
      for (int i = 0; i < 4; ++i) {
        const int x = left + any(0, 4);
        const int y = any(14, 40);
        const int width = any(1, 6);
        for (int k = 0; k < width * any(1, 4); ++k) mask.erase({x + k % width, y + k / width});
      }
    // From the left of the first pixel of each hole a line upwards, as rt-utils draws it: of three
    // pixels, with a round end.
    testing::Mask drawn = mask;
    testing::Mask ends;
    for (int left = 3; left + 14 < size; left += 14) {
      testing::Pixel start{0, size};
      for (int y = size - 1; y > 10; --y)
        for (int x = left + 12; x >= left; --x)
          if (body.contains({x, y}) && !mask.contains({x, y})) start = {x - 1, y};
      drawn.erase({start[0], start[1] + 1});
      for (int y = start[1]; y >= 0; --y)
        for (int x = start[0] - 1; x <= start[0] + 1; ++x) drawn.erase({x, y});
      for (int y = start[1] - 2; y <= start[1] + 4; ++y)
        for (int x = start[0] - 1; x <= start[0] + 1; ++x) ends.insert({x, y});
    }
    Contours contours;
    for (const auto& outline : testing::pixel_centre_outlines(drawn)) {
      Pixels pixels;
      for (const auto& [x, y] : outline) pixels.emplace_back(x, y);
      if (pixels.size() > 1) contours.push_back(contour(pixels));
    }
    ASSERT_EQ(pixels_of(contours, size), drawn) << "the drawing of round " << round;
    ASSERT_EQ(close_pin_holes(contours).count, 3U);
    const testing::Mask found = pixels_of(contours, size);
    for (const testing::Pixel& pixel : body)
      ASSERT_TRUE(found.contains(pixel) == mask.contains(pixel) || ends.contains(pixel))
          << "pixel " << pixel[0] << ", " << pixel[1] << " of round " << round;
  }
}

TEST(PinHoles, AreGoneOnceTheyAreClosed) {
  const auto seed = std::random_device{}();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  const auto any = [&](int end) { return static_cast<int>(random() % static_cast<unsigned>(end)); };
  std::size_t count = 0;
  for (int round = 0; round < 300 || (count == 0 && round < 30'000); ++round) {  // few have any
    // Anything on a lattice, with long sides four or more apart.
    Contours contours{contour({{50, 50}, {51, 50}, {51, 51}})};
    for (int i = 0; i < 4; ++i) {
      Pixels pixels;
      for (int k = 0; k < 6; ++k) {
        const int x = 4 * any(6);
        pixels.insert(pixels.end(), {{x, any(24)}, {x, any(24)}});
      }
      contours.push_back(contour(pixels));
    }
    const std::size_t closed = close_pin_holes(contours).count;
    ASSERT_EQ(close_pin_holes(contours).count, 0U) << "round " << round;
    std::size_t points = 0;
    for (const SpaceContour& each : contours) points += each.points.size();
    ASSERT_LE(points, 3 + 4 * 12 + 2 * closed) << "round " << round;
    count += closed;
  }
  EXPECT_GT(count, 0U);
}

TEST(PinHoles, AreFoundInWideImages) {
  // A pixel is little, compared to where the farthest point is.
  Contours contours{contour(ring(8, 4)), contour({{900, 5}, {901, 5}, {900, 906}})};
  EXPECT_EQ(close_pin_holes(contours).count, 1U);
}

TEST(PinHoles, AreLeftWherePointsAreOnNoLattice) {
  Contours contours{contour(ring(8, 4)), contour({{30, 30}, {33, 30}, {30, 33}})};
  contours[1].points[1][0] += 0.4 * pitch;
  const auto drawn = points_of(contours);
  EXPECT_EQ(close_pin_holes(contours).count, 0U);
  EXPECT_EQ(points_of(contours), drawn);
  Contours none;
  EXPECT_EQ(close_pin_holes(none).count, 0U);
  Contours point{contour({{0, 0}, {0, 0}})};
  EXPECT_EQ(close_pin_holes(point).count, 0U);
}

TEST(PinHoles, WithoutNumberEndTheSearch) {
  // Sides upon each other, each with each of the others, and nothing outside between them.
  Contours contours;
  for (int i = 0; i < 3001; ++i) contours.push_back(contour({{0, 0}, {0, 10}, {4, 10}, {4, 0}}));
  contours.push_back(contour({{30, 0}, {31, 0}, {30, 1}}));
  EXPECT_EQ(close_pin_holes(contours).count, 0U);
  EXPECT_EQ(contours.size(), 3002U);
}

}  // namespace
}  // namespace loft::io
