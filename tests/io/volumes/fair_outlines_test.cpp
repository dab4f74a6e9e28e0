// SPDX-License-Identifier: MIT
// Outline::fair: as smooth as the half pixel allows that a mask leaves open.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "io/volumes/outlines.h"
#include "tests/io/volumes/masks.h"

namespace loft::io {
namespace {

using testing::area;
using testing::differing_pixels;
using testing::number_as_name;
using testing::volume_of;

Slice fair_slice(std::uint32_t columns, std::uint32_t rows, std::vector<double> pixels) {
  return trace(volume_of(columns, rows, std::move(pixels)), {.outline = Outline::fair}).slices[0];
}

/// Labels 0 to 3 in patches, as in a segmentation.
std::vector<double> patches(std::uint32_t size, std::mt19937_64& random) {
  std::uniform_real_distribution<double> share(0, 1);
  std::vector<std::array<double, 3>> seeds(12);
  for (auto& [x, y, label] : seeds) {
    x = size * share(random);
    y = size * share(random);
    label = static_cast<double>(random() % 4);
  }
  seeds[0][2] = 1;
  std::vector<double> pixels;
  for (std::uint32_t y = 0; y < size; ++y)
    for (std::uint32_t x = 0; x < size; ++x)
      pixels.push_back((*std::ranges::min_element(
          seeds, {}, [&](const auto& seed) { return std::hypot(seed[0] - x, seed[1] - y); }))[2]);
  return pixels;
}

bool has_squares_of_diagonals(const std::vector<double>& pixels, std::uint32_t size) {
  for (std::uint32_t i = 0; i + size + 1 < pixels.size(); ++i) {
    if (i % size + 1 == size) continue;
    const double a = pixels[i];
    const double b = pixels[i + 1];
    const double c = pixels[i + size];
    const double d = pixels[i + size + 1];
    if ((a == d && a != b && a != c) || (b == c && b != a && b != d)) return true;
  }
  return false;
}

TEST(FairOutlines, GiveTheMaskBackAtPixelCentres) {
  const auto seed = std::random_device{}();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937_64 random(seed);
  for (int round = 0; round < 60; ++round) {
    const bool is_noise = round % 2 == 0;  // every kind of square
    const std::vector<double> pixels =
        is_noise ? testing::random_pixels(256, 3, random) : patches(16, random);
    const Stack stack = trace(volume_of(16, 16, pixels), {.outline = Outline::fair});
    ASSERT_EQ(differing_pixels(stack, 16, 16, {pixels.begin(), pixels.end()}, number_as_name), 0U)
        << "round " << round;
  }
}

TEST(FairOutlines, EncloseAsMuchAsTheirPixels) {
  const auto seed = std::random_device{}();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937_64 random(seed);
  for (int round = 0; round < 40; ++round) {
    const std::vector<double> pixels = patches(32, random);
    if (has_squares_of_diagonals(pixels, 32)) continue;
    const Slice slice = fair_slice(32, 32, pixels);
    for (const int label : {1, 2, 3}) {
      const auto count = static_cast<double>(std::ranges::count(pixels, label));
      ASSERT_NEAR(area(slice, std::to_string(label)), count, 1e-6 * count) << "round " << round;
    }
    for (const Contour& contour : slice.contours) {
      const double pixels_inside = std::round(area(contour.points));
      ASSERT_NEAR(area(contour.points), pixels_inside, 1e-6 * std::abs(pixels_inside));
    }
  }
}

TEST(FairOutlines, OfPixelsThatAreAloneAndOfThinPartsKeepAllOfThem) {
  std::vector<double> pixels(100);
  pixels[11] = 1;                                                                 // alone
  for (const std::size_t i : {31U, 32U, 33U, 34U, 44U, 54U, 64U}) pixels[i] = 2;  // one pixel wide
  for (const std::size_t i : {17U, 28U}) pixels[i] = 3;  // they meet in a corner
  const Slice slice = fair_slice(10, 10, pixels);
  EXPECT_NEAR(area(slice, "1"), 1, 1e-6);
  EXPECT_NEAR(area(slice, "2"), 7, 1e-6);
  EXPECT_NEAR(area(slice, "3"), 2, 1e-6);
  EXPECT_EQ(std::ranges::count(slice.contours, "3", &Contour::label), 2);
}

/// Directed edges of all outlines of a slice, with their numbers.
std::map<std::pair<cdt::Point, cdt::Point>, int> edges_of(const Slice& slice) {
  std::map<std::pair<cdt::Point, cdt::Point>, int> edges;
  for (const Contour& contour : slice.contours)
    for (std::size_t i = 0; i < contour.points.size(); ++i)
      ++edges[{contour.points[i], contour.points[(i + 1) % contour.points.size()]}];
  return edges;
}

TEST(FairOutlines, OfNeighboursLeaveNoGap) {
  const auto seed = std::random_device{}();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937_64 random(seed);
  for (int round = 0; round < 40; ++round) {
    // No pixel without a label: all but the rim has a label on either side.
    std::vector<double> pixels = testing::random_pixels(100, 2, random);
    for (double& pixel : pixels) ++pixel;
    const Slice slice = fair_slice(10, 10, pixels);
    const auto edges = edges_of(slice);
    double rim = 0;  // what edges without another side enclose
    for (const auto& [edge, count] : edges) {
      ASSERT_EQ(count, 1);
      const auto& [a, b] = edge;
      if (!edges.contains({b, a})) rim += (a.x * b.y - b.x * a.y) / 2;
    }
    const double sum = area(slice, "1") + area(slice, "2") + area(slice, "3");
    ASSERT_NEAR(sum, rim, 1e-9) << "round " << round;
    for (const auto& [edge, count] : edges) {
      const auto& [a, b] = edge;
      const bool is_inner =
          std::min({a.x, a.y, b.x, b.y}) > 0 && std::max({a.x, a.y, b.x, b.y}) < 9;
      if (is_inner) {
        ASSERT_TRUE(edges.contains({b, a})) << "round " << round << ' ' << a << b;
      }
    }
  }
}

double length(const Slice& slice) {
  double sum = 0;
  for (const auto& [edge, count] : edges_of(slice))
    sum += std::hypot(edge.first.x - edge.second.x, edge.first.y - edge.second.y);
  return sum;
}

TEST(FairOutlines, OfADiscAreShorterThanIsoLinesAndNearlyRound) {
  std::vector<double> pixels;
  for (int y = 0; y < 41; ++y)
    for (int x = 0; x < 41; ++x) pixels.push_back(std::hypot(x - 20, y - 20) < 17.3 ? 1 : 0);
  const Slice fair = fair_slice(41, 41, pixels);
  const Slice iso = trace(volume_of(41, 41, pixels)).slices[0];
  const double round = 2 * std::sqrt(std::acos(-1.0) * area(fair, "1"));
  EXPECT_LT(length(fair), 1.002 * round);
  EXPECT_GT(length(iso), 1.04 * round);
}

}  // namespace
}  // namespace loft::io
