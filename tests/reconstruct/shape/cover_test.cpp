// SPDX-License-Identifier: MIT
#include "reconstruct/shape/cover.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "mesh/vec3.h"
#include "tests/reconstruct/triangles.h"

namespace loft {
namespace {

/// A square of n by n cells, two faces each, with a height at each corner.
struct Field {
  std::vector<Corners> faces;
  std::vector<Cover::Neighbours> neighbours;
  std::vector<std::uint32_t> all;
};

template <class Height>
Field field(std::uint32_t n, Height height) {
  Field result;
  const auto at = [&](std::uint32_t i, std::uint32_t j) {
    return Vec3{1.0 * i / n, 1.0 * j / n, height(1.0 * i / n, 1.0 * j / n)};
  };
  const auto face = [n](std::uint32_t i, std::uint32_t j, std::uint32_t half) {
    return i < n && j < n ? 2 * (i * n + j) + half : Cover::none;
  };
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = 0; j < n; ++j) {
      result.faces.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      result.neighbours.push_back({face(i, j - 1, 1), face(i + 1, j, 1), face(i, j, 1)});
      result.faces.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
      result.neighbours.push_back({face(i, j, 0), face(i, j + 1, 0), face(i - 1, j, 0)});
    }
  }
  result.all.resize(result.faces.size());
  std::iota(result.all.begin(), result.all.end(), 0U);
  return result;
}

double farthest(const Corners& whole, std::span<const Corners> faces) {
  constexpr int steps = 16;
  double most = 0;
  for (int i = 0; i <= steps; ++i) {
    for (int j = 0; i + j <= steps; ++j) {
      const Vec3 on_edge = along(whole[0], 1.0 * i / steps, minus(whole[1], whole[0]));
      const Vec3 p = along(on_edge, 1.0 * j / steps, minus(whole[2], whole[0]));
      double least = 1e9;
      for (const auto& [a, b, c] : faces) least = std::min(least, triangles::distance(p, a, b, c));
      most = std::max(most, least);
    }
  }
  return most;
}

TEST(Cover, AFlatFieldCoversWhatLiesOnItAndNothingThatLeavesIt) {
  const Field flat = field(7, [](double, double) { return 0.0; });
  Cover cover(flat.faces, flat.neighbours, 0.01);
  EXPECT_TRUE(cover.covers({Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{1, 1, 0}}, flat.all));
  EXPECT_TRUE(cover.covers({Vec3{0.1, 0.2, 0.009}, Vec3{1, 0, 0}, Vec3{0.5, 1, 0}}, flat.all));
  EXPECT_FALSE(cover.covers({Vec3{0.1, 0.2, 0.011}, Vec3{1, 0, 0}, Vec3{0.5, 1, 0}}, flat.all));
  EXPECT_FALSE(cover.covers({Vec3{0, 0, 0}, Vec3{1.1, 0, 0}, Vec3{0.5, 0.6, 0}}, flat.all));
  EXPECT_FALSE(cover.covers({Vec3{0, 0, 0}, Vec3{1, 1, 0}, Vec3{1, 0, 0}}, flat.all));  // behind
}

TEST(Cover, AFieldWithAHoleDoesNotCoverIt) {
  Field holed = field(5, [](double, double) { return 0.0; });
  for (Cover::Neighbours& n : holed.neighbours)
    std::ranges::replace(n, 2U * (2 * 5 + 1), Cover::none);
  std::erase(holed.all, 2U * (2 * 5 + 1));
  Cover cover(holed.faces, holed.neighbours, 0.01);
  EXPECT_FALSE(cover.covers({Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{1, 1, 0}}, holed.all));
  EXPECT_TRUE(cover.covers({Vec3{0.7, 0.1, 0}, Vec3{1, 0.1, 0}, Vec3{0.9, 0.9, 0}}, holed.all));
}

TEST(Cover, WhatAnyFieldCoversIsNearIt) {
  int covered = 0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> place(0, 1);
    const double wave = 10 * place(random);
    const Field hills = field(
        6, [&](double x, double y) { return 0.1 * std::sin(wave * x) + 0.05 * std::cos(9 * y); });
    const double distance = 0.2 * place(random);
    Cover cover(hills.faces, hills.neighbours, distance);
    Corners triangle{};
    for (Vec3& p : triangle) p = {place(random), place(random), 0.1 * place(random)};
    if (!cover.covers(triangle, hills.all)) continue;
    ++covered;
    EXPECT_LE(farthest(triangle, hills.faces), distance + 1e-12) << "seed " << seed;
  }
  EXPECT_GT(covered, 20);
}

}  // namespace
}  // namespace loft
