// SPDX-License-Identifier: MIT
// Volumes in memory, and what their outlines must enclose.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <random>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "io/volumes/volume.h"
#include "reconstruct/slice.h"
#include "reconstruct/stack.h"

namespace loft::io::testing {

/// A volume of one layer with those pixels, x first.
inline Volume volume_of(std::uint32_t columns, std::uint32_t rows, std::vector<double> pixels) {
  Volume volume;
  volume.name = "a.nii";
  volume.columns = columns;
  volume.rows = rows;
  volume.slices = static_cast<std::uint32_t>(pixels.size() / columns / rows);
  volume.read = [pixels = std::move(pixels)](std::uint32_t slice, std::uint32_t,
                                             std::span<double> out) {
    std::copy_n(&pixels[slice * out.size()], out.size(), out.begin());
  };
  return volume;
}

inline std::vector<double> random_pixels(std::size_t count, int labels, std::mt19937_64& random) {
  std::vector<double> pixels(count);
  for (double& pixel : pixels)
    pixel = static_cast<double>(random() % static_cast<unsigned>(labels + 1));
  return pixels;
}

/// Whether contours of a label enclose a place, by the even-odd rule.
inline bool encloses(const Slice& slice, const std::string& label, const cdt::Point& place) {
  bool is_inside = false;
  for (const Contour& contour : slice.contours) {
    if (contour.label != label) continue;
    for (std::size_t i = 0; i < contour.points.size(); ++i) {
      const cdt::Point& a = contour.points[i];
      const cdt::Point& b = contour.points[(i + 1) % contour.points.size()];
      if ((a.y > place.y) == (b.y > place.y)) continue;
      if (place.x < a.x + (place.y - a.y) * (b.x - a.x) / (b.y - a.y)) is_inside = !is_inside;
    }
  }
  return is_inside;
}

inline double area(const std::vector<cdt::Point>& points) {
  double twice = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const cdt::Point& a = points[i];
    const cdt::Point& b = points[(i + 1) % points.size()];
    twice += a.x * b.y - b.x * a.y;
  }
  return twice / 2;
}

/// The area that a label's outlines enclose: those around holes turn the other way.
inline double area(const Slice& slice, const std::string& label) {
  double sum = 0;
  for (const Contour& contour : slice.contours)
    if (contour.label == label) sum += area(contour.points);
  return sum;
}

/// How many pixels of a stack's slices are not as these are, x first: at their centres, so far
/// apart, the contours of their label are to enclose them, by the name that it has for a value, and
/// those of no other value.
template <class Name>
std::size_t differing_pixels(const Stack& stack, std::size_t columns, std::size_t rows,
                             const std::vector<int>& pixels, const Name& name, double x_step = 1,
                             double y_step = 1) {
  const std::set<int> values(pixels.begin(), pixels.end());
  std::size_t count = pixels.size() == stack.slices.size() * columns * rows ? 0 : pixels.size();
  for (std::size_t i = 0; i < pixels.size() && count < pixels.size(); ++i) {
    const cdt::Point centre{x_step * (static_cast<double>(i % columns) + 1e-9),
                            y_step * (static_cast<double>(i / columns % rows) + 2e-9)};
    for (const int value : values)
      if (value != 0)
        count +=
            encloses(stack.slices[i / columns / rows], name(value), centre) != (pixels[i] == value)
                ? 1U
                : 0U;
  }
  return count;
}
inline std::string number_as_name(int value) { return std::to_string(value); }

/// Whole numbers from 1 to `labels`, and 0 about as often as all of them.
inline std::vector<int> random_labels(std::size_t count, int labels, std::mt19937_64& random) {
  std::vector<int> pixels(count);
  for (int& pixel : pixels)
    pixel = random() % 2 == 0 ? 0 : static_cast<int>(random() % static_cast<unsigned>(labels)) + 1;
  pixels[random() % count] = 1;  // nothing at all would be refused
  return pixels;
}

/// A slice of 3 x 2 pixels of a byte, of which (1, 0) is 1 and (2, 1) is 2; and two of them.
inline const std::string two_label_slice("\0\1\0\0\0\2", 6);
inline const std::string two_label_pixels = two_label_slice + two_label_slice;

/// The volume that the tests of NRRD and MetaImage write, in millimetres: its pixels are where the
/// header puts them.
inline void expect_two_labels_in_place(const Stack& stack) {
  ASSERT_EQ(stack.slices.size(), 2U);
  EXPECT_EQ(stack.slices[0].z, 30);
  EXPECT_EQ(stack.slices[1].z, 35);
  EXPECT_EQ(stack.unit, "mm");
  EXPECT_FALSE(stack.frame);
  EXPECT_TRUE(encloses(stack.slices[0], "1", {12, 20}));
  EXPECT_TRUE(encloses(stack.slices[1], "2", {14, 23}));
  EXPECT_FALSE(encloses(stack.slices[0], "1", {10, 20}));
}

}  // namespace loft::io::testing
