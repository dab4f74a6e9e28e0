// SPDX-License-Identifier: MIT
// Heights and outlines that differ by rounding are one.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "reconstruct/clean/heights.h"
#include "reconstruct/reconstruct.h"
#include "tests/reconstruct/stacks.h"

namespace loft {
namespace {

std::vector<double> heights(const std::vector<double>& z, double tolerance = 1e-4) {
  std::vector<Defect> repairs;
  std::vector<double> found;
  for (const Height& height : find_heights(z, tolerance, repairs)) found.push_back(height.z);
  EXPECT_EQ(repairs.size() + found.size(), z.size()) << "each that is merged is reported";
  return found;
}

TEST(Heights, ThatDifferByRoundingAreOne) {
  using Heights = std::vector<double>;
  EXPECT_EQ(heights({3, 0, 1e-9, 3 + 1e-9, 6}), (Heights{0, 3, 6}));
  EXPECT_EQ(heights({0, 1e-9, 2e-9, 5}), (Heights{0, 5}));
  EXPECT_EQ(heights({0, 0, 5}), (Heights{0, 5}));
}

TEST(Heights, ThatAreUnevenStayApart) {
  using Heights = std::vector<double>;
  EXPECT_EQ(heights({0, 1e-9}), (Heights{0, 1e-9})) << "there is no larger gap";
  EXPECT_EQ(heights({0, 0.01, 5}), (Heights{0, 0.01, 5}));
  EXPECT_EQ(heights({0, 1e-9, 5}, 0), (Heights{0, 1e-9, 5})) << "nothing is asked for";
  Heights run{1e6};
  for (int i = 0; i < 200; ++i) run.push_back(i);
  std::ranges::sort(run);
  EXPECT_EQ(heights(run), run) << "a long run of small gaps is no rounding";
}

TEST(Heights, OfTwoPartsThatDifferByRoundingMakeTwoPrisms) {
  std::vector<Slice> slices;
  for (int i = 0; i < 4; ++i) {
    slices.push_back({3.0 * i, {stacks::square(2)}});
    slices.push_back({3.0 * i + 1e-9, {stacks::square(1, {9, 0})}});
  }
  const Reconstructed made = reconstruct(slices, {.height_tolerance = 1e-4});
  EXPECT_EQ(measure(made.surface).components, 2U);
  EXPECT_NEAR(measure(made.surface).volume, 9 * (16 + 4), 1e-6);
  EXPECT_EQ(made.repairs.size(), 4U);
}

/// The contour once more: other points, each off the outline by at most `noise`.
Contour again(const Contour& contour, double noise, std::mt19937_64& random) {
  std::uniform_real_distribution<double> off(-noise / 2, noise / 2);
  Contour copy;
  for (std::size_t i = 0; i < contour.points.size(); ++i) {
    const cdt::Point a = contour.points[i];
    const cdt::Point b = contour.points[(i + 1) % contour.points.size()];
    copy.points.push_back({a.x + off(random), a.y + off(random)});
    if (i % 3 == 0)
      copy.points.push_back({(a.x + b.x) / 2 + off(random), (a.y + b.y) / 2 + off(random)});
  }
  std::rotate(copy.points.begin(), copy.points.begin() + 5, copy.points.end());
  if (random() % 2 == 0) std::ranges::reverse(copy.points);
  return copy;
}

TEST(Outlines, SavedTwiceWithNoiseAreOne) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    std::mt19937_64 random(seed);
    std::vector<Slice> slices;
    for (int z = 0; z < 3; ++z) {
      const Contour disc = stacks::circle(60, 10, {1, 2}, 0.1 * z);
      slices.push_back({double(z), {disc, again(disc, 1e-7, random)}});
      if (random() % 2 == 0) std::swap(slices.back().contours[0], slices.back().contours[1]);
    }
    const Reconstructed made = reconstruct(slices);
    EXPECT_EQ(measure(made.surface).components, 1U) << "seed " << seed;
    EXPECT_NEAR(measure(made.surface).volume, 627.2, 2) << "seed " << seed;
    EXPECT_EQ(std::ranges::count(made.repairs, DefectKind::repeated_contour, &Defect::kind), 3)
        << "seed " << seed;
  }
}

TEST(Outlines, NearEachOtherThatAreTwoStayTwo) {
  std::vector<Slice> slices;
  for (int z = 0; z < 2; ++z)
    slices.push_back({double(z), {stacks::circle(60, 10), stacks::circle(60, 10 - 1e-3)}});
  const Reconstructed made = reconstruct(slices);
  EXPECT_EQ(measure(made.surface).genus, 1);
  EXPECT_TRUE(made.repairs.empty());
}

}  // namespace
}  // namespace loft
