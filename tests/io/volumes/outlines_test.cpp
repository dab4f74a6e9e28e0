// SPDX-License-Identifier: MIT
#include "io/volumes/outlines.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <set>

#include "io/volumes/sparse_table.h"
#include "reconstruct/defect.h"
#include "tests/io/shapes.h"
#include "tests/io/volumes/masks.h"

namespace loft::io {
namespace {

using testing::area;
using testing::encloses;
using testing::message_of;
using testing::random_pixels;
using testing::volume_of;

constexpr Outline drawings[]{Outline::iso_lines, Outline::edges, Outline::fair};

using Points = std::vector<cdt::Point>;

TEST(Outlines, OfASinglePixelAreADiamondOrItsEdges) {
  const Volume volume = volume_of(1, 1, {7});
  const Stack iso = trace(volume);
  ASSERT_EQ(iso.slices.size(), 1U);
  ASSERT_EQ(iso.slices[0].contours.size(), 1U);
  EXPECT_EQ(iso.slices[0].contours[0].points, (Points{{-.5, 0}, {0, -.5}, {.5, 0}, {0, .5}}));
  EXPECT_EQ(iso.slices[0].contours[0].label, "7");
  EXPECT_EQ(iso.fill, Fill::even_odd);
  EXPECT_EQ(iso.gap, 1);
  const Stack edges = trace(volume, {.outline = Outline::edges});
  EXPECT_EQ(edges.slices[0].contours[0].points,
            (Points{{-.5, -.5}, {.5, -.5}, {.5, .5}, {-.5, .5}}));
}

/// Points that contours of a label go through more than once.
std::size_t repeated_points(const Slice& slice, const std::string& label) {
  std::set<cdt::Point> seen;
  std::size_t count = 0;
  for (const Contour& contour : slice.contours) {
    if (contour.label != label) continue;
    count += contour.points.size();
    seen.insert(contour.points.begin(), contour.points.end());
  }
  return count - seen.size();
}

TEST(Outlines, EncloseTheCentresOfTheirPixelsAndNoOthers) {
  const auto seed = std::random_device{}();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937_64 random(seed);
  for (int round = 0; round < 200; ++round) {
    const auto columns = static_cast<std::uint32_t>(1 + random() % 12);
    const auto rows = static_cast<std::uint32_t>(1 + random() % 12);
    const int labels = 1 + static_cast<int>(random() % 4);
    std::vector<double> pixels = random_pixels(std::size_t{2} * columns * rows, labels, random);
    pixels[random() % pixels.size()] = 1;  // nothing at all would be refused
    for (const Outline outline : drawings) {
      const Stack stack = trace(volume_of(columns, rows, pixels), {.outline = outline});
      ASSERT_EQ(stack.slices.size(), 2U);
      for (std::size_t i = 0; i < pixels.size(); ++i) {
        const cdt::Point centre{static_cast<double>(i % columns) + 1e-9,
                                static_cast<double>(i / columns % rows) + 2e-9};
        for (int label = 1; label <= labels; ++label)
          ASSERT_EQ(encloses(stack.slices[i / columns / rows], std::to_string(label), centre),
                    pixels[i] == label)
              << "pixel " << i << " label " << label;
      }
      for (const Slice& slice : stack.slices)
        for (int label = 1; label <= labels; ++label)
          ASSERT_EQ(repeated_points(slice, std::to_string(label)), 0U);
    }
  }
}

TEST(Outlines, OfNothingAreRefused) {
  EXPECT_THROW(static_cast<void>(trace(volume_of(2, 1, {0, 0}))), InputError);
}

TEST(Outlines, OfLabelsDoNotOverlap) {
  const auto seed = std::random_device{}();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937_64 random(seed);
  const std::vector<double> pixels = random_pixels(100, 3, random);
  for (const Outline outline : drawings) {
    const Stack stack = trace(volume_of(10, 10, pixels), {.outline = outline});
    for (int i = 0; i < 20000; ++i) {
      std::uniform_real_distribution<double> place(-1, 11);
      const cdt::Point point{place(random), place(random)};
      int count = 0;
      for (const char* label : {"1", "2", "3"}) count += encloses(stack.slices[0], label, point);
      ASSERT_LE(count, 1) << point;
    }
  }
}

TEST(Outlines, OfNeighboursAreTheSameLine) {
  // Two labels side by side fill their rectangle: together they have its area, without its corners.
  const std::vector<double> pixels{1, 1, 2, 2, 1, 2, 2, 2, 1, 1, 1, 2};
  const Slice iso = trace(volume_of(4, 3, pixels)).slices[0];
  EXPECT_EQ(area(iso, "1") + area(iso, "2"), 12 - 4 * 0.125 - 4 * 0.125);
  const Slice edges = trace(volume_of(4, 3, pixels), {.outline = Outline::edges}).slices[0];
  EXPECT_EQ(area(edges, "1") + area(edges, "2"), 12);
  EXPECT_EQ(area(edges, "1"), 6);
}

TEST(Outlines, OfThreeLabelsThatMeetLeaveAGapOnly) {
  const Slice iso = trace(volume_of(2, 2, {1, 1, 2, 3})).slices[0];
  // Each square between four centres: one eighth each cut off at the two lower ones.
  EXPECT_FALSE(encloses(iso, "1", {0.5, 0.55}));
  EXPECT_FALSE(encloses(iso, "2", {0.5, 0.55}));
  EXPECT_FALSE(encloses(iso, "3", {0.5, 0.55}));
  EXPECT_TRUE(encloses(iso, "2", {0.2, 0.75}));
}

TEST(Outlines, KeepPixelsApartThatMeetInACorner) {
  for (const Outline outline : drawings) {
    const Slice slice = trace(volume_of(2, 2, {1, 0, 0, 1}), {.outline = outline}).slices[0];
    ASSERT_EQ(slice.contours.size(), 2U);
    EXPECT_FALSE(encloses(slice, "1", {0.5, 0.5}));
  }
  // A hole that reaches the outside by a corner is a part of it.
  const std::vector<double> ring{1, 1, 1, 1, 0, 1, 1, 1, 0};
  for (const Outline outline : drawings)
    EXPECT_EQ(trace(volume_of(3, 3, ring), {.outline = outline}).slices[0].contours.size(), 1U);
}

TEST(Outlines, CrossSharesWhereALineBetweenThemDoes) {
  Volume volume = volume_of(3, 1, {0, 1, 0.25});
  volume.level = 0.5;
  const Stack stack = trace(volume);
  ASSERT_EQ(stack.slices[0].contours.size(), 1U);
  EXPECT_EQ(stack.slices[0].contours[0].points,
            (Points{{0.5, 0}, {1, -.5}, {1 + 2.0 / 3, 0}, {1, .5}}));
  EXPECT_EQ(stack.slices[0].contours[0].label, "layer 1");
}

TEST(Outlines, OfSharesEncloseWhatReachesTheLevel) {
  const auto seed = std::random_device{}();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937_64 random(seed);
  std::vector<double> pixels(400);
  for (double& pixel : pixels) pixel = static_cast<double>(random() % 5) / 4;  // often the level
  pixels[7] = std::nan("");
  pixels[9] = std::numeric_limits<double>::infinity();
  Volume volume = volume_of(20, 20, pixels);
  volume.level = 0.5;
  volume.labels = {{{"liver", Colour{1, 2, 3}}}};
  for (const Outline outline : drawings) {
    const Slice slice = trace(volume, {.outline = outline}).slices[0];
    for (std::size_t i = 0; i < pixels.size(); ++i)
      ASSERT_EQ(encloses(slice, "liver",
                         {static_cast<double>(i % 20) + 1e-9, static_cast<double>(i / 20) + 2e-9}),
                pixels[i] >= 0.5)
          << i;
    EXPECT_EQ(repeated_points(slice, "liver"), 0U);
  }
}

TEST(Outlines, EmptySlicesStay) {
  const Stack stack = trace(volume_of(1, 1, {1, 0, 1, 0}));
  ASSERT_EQ(stack.slices.size(), 4U);
  EXPECT_TRUE(stack.slices[1].contours.empty());
  EXPECT_EQ(stack.slices[2].z, 2);
}

TEST(Outlines, AreInTheWorldWhereItsAxesAreThePixels) {
  Volume volume = volume_of(2, 1, {1, 1, 1, 1});
  volume.to_world = {{{0, 3, 0, 10}, {-2, 0, 0, 20}, {0, 0, -5, 30}}};
  const Stack stack = trace(volume, {.outline = Outline::edges});
  EXPECT_EQ(stack.frame, std::nullopt);
  EXPECT_EQ(stack.gap, 5);
  EXPECT_EQ(stack.slices[1].z, 25);
  const std::set<cdt::Point> corners(stack.slices[1].contours[0].points.begin(),
                                     stack.slices[1].contours[0].points.end());
  EXPECT_EQ(corners, (std::set<cdt::Point>{{8.5, 21}, {11.5, 21}, {8.5, 17}, {11.5, 17}}));
}

TEST(Outlines, AreInAFrameElsewhere) {
  // Sagittal, mirrored and sheared ones: places in the world are where the matrix puts them.
  const std::array<std::array<double, 4>, 3> matrices[]{
      {{{0, 0, 4, 7}, {3, 0, 0, 8}, {0, 2, 0, 9}}},
      {{{0, 0, -4, 7}, {3, 0, 0, 8}, {0, 2, 0, 9}}},
      {{{-1, 0.25, 0.5, 1}, {0.5, 2, 0, 2}, {0.25, 0, 3, 3}}},
  };
  for (const auto& matrix : matrices) {
    Volume volume = volume_of(1, 1, {1, 1, 1});
    volume.to_world = matrix;
    const Stack stack = trace(volume);
    ASSERT_TRUE(stack.frame);
    EXPECT_EQ(fault(*stack.frame), "");
    EXPECT_NEAR(stack.frame->determinant(), 1, 1e-12);
    const Points pixel{{-.5, 0}, {0, -.5}, {.5, 0}, {0, .5}};
    for (std::size_t k = 0; k < 3; ++k) {
      const Slice& slice = stack.slices[k];
      for (std::size_t i = 0; i < 4; ++i) {
        const cdt::Point& point = slice.contours[0].points[i];
        const Vec3 world = stack.frame->at({point.x, point.y, slice.z});
        for (std::size_t axis = 0; axis < 3; ++axis)
          EXPECT_NEAR(world[axis],
                      matrix[axis][0] * pixel[i].x + matrix[axis][1] * pixel[i].y +
                          matrix[axis][2] * static_cast<double>(k) + matrix[axis][3],
                      1e-12);
      }
    }
  }
}

TEST(Outlines, LieWhereUnevenSlicesDo) {
  Volume volume = volume_of(1, 1, {1, 1, 1});
  volume.to_world[2][2] = 2;
  volume.positions = {0, 1, 80};
  const Stack stack = trace(volume);
  EXPECT_EQ(stack.slices[2].z, 160);
  EXPECT_EQ(stack.gap, 2);
}

TEST(Outlines, TellOfLabelsThatAreThere) {
  Volume volume = volume_of(4, 1, {1, 2, 3, 9});
  volume.labels = {{{"lung", Colour{1, 2, 3}, "a"}, 0, 1},
                   {{"lung", {}, "b"}, 0, 2},
                   {{"", {}, "c"}, 0, 3},
                   {{"gone", {}, "d"}, 0, 4}};
  const Stack stack = trace(volume);
  ASSERT_EQ(stack.labels.size(), 4U);
  EXPECT_EQ(stack.labels[0], (StackLabel{"lung", Colour{1, 2, 3}, "a"}));
  EXPECT_EQ(stack.labels[1].name, "lung (b)");
  EXPECT_EQ(stack.labels[2].name, "c");
  EXPECT_EQ(stack.labels[3], (StackLabel{"9", {}, "9"}));
  ASSERT_EQ(stack.notes.size(), 1U);
  EXPECT_EQ(stack.notes[0], "a.nii: labels without a pixel, left out: gone");
}

TEST(Outlines, OfLayersMayOverlap) {
  Volume volume = volume_of(1, 1, {1});
  volume.layers = 2;
  volume.labels = {{{"inner"}, 1, 1}, {{"outer"}, 0, 1}};
  const Slice slice = trace(volume).slices[0];
  ASSERT_EQ(slice.contours.size(), 2U);
  EXPECT_EQ(slice.contours[0].label, "outer");
  EXPECT_EQ(slice.contours[1].label, "inner");
  EXPECT_EQ(slice.contours[0].points, slice.contours[1].points);
}

TEST(Outlines, NeedASpacing) {
  Volume volume = volume_of(1, 1, {1, 1});
  volume.has_spacing = false;
  EXPECT_EQ(message_of<InputError>([&] { static_cast<void>(trace(volume)); }),
            "a.nii: it does not say the distances between columns, rows and slices; give them with "
            "--spacing x,y,z");
  const Stack stack = trace(volume, {.spacing = Vec3{2, 3, 4}, .outline = Outline::edges});
  EXPECT_EQ(stack.slices[1].z, 4);
  EXPECT_EQ(area(stack.slices[0], "1"), 6);
  volume.to_world = {{{-1, 0, 0, 5}, {0, 0, 0, 0}, {0, 0, 9, 0}}};  // mirrored, flat
  EXPECT_EQ(
      area(trace(volume, {.spacing = Vec3{2, 3, 4}, .outline = Outline::edges}).slices[1], "1"),
      -6);
  EXPECT_THROW(static_cast<void>(trace(volume, {.spacing = Vec3{2, 0, 4}})), InputError);
}

TEST(Outlines, RefuseWhatIsNoVolume) {
  const auto refuse = [](const auto& change, std::string_view what) {
    Volume volume = volume_of(1, 1, {1, 1});
    change(volume);
    EXPECT_NE(message_of<InputError>([&] { static_cast<void>(trace(volume)); }).find(what),
              std::string::npos)
        << what;
  };
  refuse([](Volume& volume) { volume.slices = 0; }, "there must be some");
  refuse([](Volume& volume) { volume.rows = 1U << 31; }, "2^28 pixels at most");
  refuse([](Volume& volume) { volume.to_world[1][1] = 0; }, "the distance between its rows is 0");
  refuse(
      [](Volume& volume) {
        volume.to_world[0] = {1, 1, 0, 0};
        volume.to_world[1] = {0, 0, 0, 0};
      },
      "is singular");
  refuse([](Volume& volume) { volume.to_world[2][3] = std::nan(""); }, "a number that is none");
  for (const double value : {-1.0, 0.5, 1e10}) {
    Volume volume = volume_of(1, 1, {value});
    EXPECT_NE(message_of<InputError>([&] { static_cast<void>(trace(volume)); }).find("--level"),
              std::string::npos);
  }
}

TEST(SparseTable, HasTheNumbersThatWereSet) {
  constexpr std::size_t size = 10'000;
  SparseTable table(size);
  std::mt19937 random(20261130);
  for (int round = 0; round < 3; ++round) {
    std::map<std::size_t, std::uint32_t> expected;
    for (int i = 0; i < 300; ++i) {
      const std::size_t place = random() % size / 40 * 40;
      const auto number = i % 5 == 0 ? SparseTable::none : static_cast<std::uint32_t>(i);
      table.set(place, number);
      expected[place] = number;
    }
    for (std::size_t place = 0; place < size; ++place) {
      const auto found = expected.find(place);
      ASSERT_EQ(table[place], found == expected.end() ? SparseTable::none : found->second);
    }
    table.clear();
  }
}

}  // namespace
}  // namespace loft::io
