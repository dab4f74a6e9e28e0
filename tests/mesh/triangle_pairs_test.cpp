// SPDX-License-Identifier: MIT
#include "mesh/triangle_pairs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "mesh/check.h"

namespace loft {
namespace {

using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

std::vector<Corners> corners_of(const Mesh& mesh) {
  std::vector<Corners> result;
  for (const auto& [a, b, c] : mesh.faces)
    result.push_back({mesh.points[a], mesh.points[b], mesh.points[c]});
  return result;
}

Pairs meeting_by_all_pairs(const std::vector<Corners>& triangles) {
  Pairs result;
  for (std::uint32_t i = 0; i < triangles.size(); ++i)
    for (std::uint32_t j = i + 1; j < triangles.size(); ++j)
      if (triangles_meet(triangles[i], triangles[j])) result.emplace_back(i, j);
  return result;
}

/// How many pairs were tested, and which of them meet.
std::pair<std::size_t, Pairs> meeting_by_tree(const Mesh& mesh) {
  const std::vector<Corners> triangles = corners_of(mesh);
  std::size_t tested = 0;
  Pairs result;
  TrianglePairs(triangles, mesh.faces, mesh.points.size())
      .for_each([&](std::uint32_t i, std::uint32_t j) {
        ++tested;
        if (triangles_meet(triangles[i], triangles[j])) result.emplace_back(std::minmax({i, j}));
      });
  std::ranges::sort(result);
  return {tested, result};
}

/// Points of a few hubs, of which all triangles take one: fans that run through each other. On a
/// lattice, so that many only touch.
Mesh random_fans(std::mt19937& random, std::uint32_t hubs, std::uint32_t count, double scale) {
  std::uniform_int_distribution place(0, 60);
  Mesh mesh;
  for (std::uint32_t i = 0; i < hubs + count; ++i)
    mesh.points.push_back({scale * place(random), scale * place(random), scale * place(random)});
  std::uniform_int_distribution<std::uint32_t> hub(0, hubs - 1);
  std::uniform_int_distribution<std::uint32_t> other(hubs, hubs + count - 1);
  while (mesh.faces.size() < count) {
    const std::array face{hub(random), other(random), other(random)};
    const auto& p = mesh.points;
    if (!collinear(p[face[0]], p[face[1]], p[face[2]])) mesh.faces.push_back(face);
  }
  return mesh;
}

/// Long thin triangles between two rings of n points, slanted.
Mesh slanted_ring(std::uint32_t n) {
  Mesh mesh;
  for (std::uint32_t i = 0; i < n; ++i) {
    const double at = 2 * std::numbers::pi * i / n;
    mesh.points.push_back({10 * std::cos(at), 10 * std::sin(at), 0});
    mesh.points.push_back({11 * std::cos(at + 0.05), 11 * std::sin(at + 0.05), 1});
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t next = (i + 1) % n;
    mesh.faces.push_back({2 * i, 2 * next, 2 * i + 1});
    mesh.faces.push_back({2 * i + 1, 2 * next, 2 * next + 1});
  }
  return mesh;
}

/// Two bands of long thin triangles, one above the other, that slant against each other: no box of
/// one runs along those of the other.
Mesh slanted_both_ways(std::uint32_t n) {
  Mesh mesh;
  for (std::uint32_t i = 0; i < n; ++i) {
    const double at = 2 * std::numbers::pi * i / n;
    for (const auto& [radius, turn, z] :
         {std::array{9.0, 0.0, 1.0}, std::array{9.3, 0.1, 1.6}, std::array{9.0, 0.2, 1.4}})
      mesh.points.push_back({radius * std::cos(at + turn), radius * std::sin(at + turn), z});
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t ring = 0; ring < 2; ++ring) {
      const std::uint32_t a = 3 * i + ring;
      const std::uint32_t b = 3 * ((i + 1) % n) + ring;
      mesh.faces.push_back({a, b, a + 1});
      mesh.faces.push_back({a + 1, b, b + 1});
    }
  }
  return mesh;
}

/// A cone of n triangles with one apex.
Mesh cone(std::uint32_t n) {
  Mesh mesh{{{1, 2, 3}}, {}};
  for (std::uint32_t i = 0; i < n; ++i) {
    const double at = 2 * std::numbers::pi * i / n;
    mesh.points.push_back({10 * std::cos(at), 10 * std::sin(at), 0});
    mesh.faces.push_back({0, 1 + i, 1 + (i + 1) % n});
  }
  return mesh;
}

TEST(TrianglePairs, FindsAllThatMeetInFansThroughEachOther) {
  constexpr unsigned seed = 31;
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  for (const std::uint32_t hubs : {1U, 3U, 40U}) {
    for (const std::uint32_t count : {3U, 60U, 400U}) {
      for (const double scale : {1.0, 1e-90, 1e90, 0.1}) {
        const Mesh mesh = random_fans(random, hubs, count, scale);
        const Pairs expected = meeting_by_all_pairs(corners_of(mesh));
        EXPECT_EQ(meeting_by_tree(mesh).second, expected) << hubs << ' ' << count << ' ' << scale;
      }
    }
  }
}

TEST(TrianglePairs, FindsTheNeighbourThatABentFanHits) {
  Mesh mesh = cone(1000);
  mesh.points[1][2] = 1e-9;
  mesh.faces.push_back({0, 500, 1});
  EXPECT_EQ(meeting_by_tree(mesh).second, meeting_by_all_pairs(corners_of(mesh)));
}

TEST(TrianglePairs, TestsAFewPairsATriangleHoweverThinTheyAre) {
  for (const std::uint32_t n : {1000U, 8000U}) {
    EXPECT_LT(meeting_by_tree(slanted_ring(n)).first, 60 * n) << n;
    EXPECT_LT(meeting_by_tree(cone(n)).first, 20 * n) << n;
    EXPECT_LT(meeting_by_tree(slanted_both_ways(n)).first, 100 * n) << n;
  }
}

TEST(TrianglePairs, StepsGrowHardlyFasterThanTriangles) {
  const auto fits = [](const Mesh& mesh, std::uint64_t steps) {
    const cdt::Effort effort(steps);
    try {
      static_cast<void>(meeting_by_tree(mesh));
    } catch (const cdt::TooMuchEffort&) {
      return false;
    }
    return true;
  };
  for (const std::uint32_t n : {1000U, 8000U}) {
    EXPECT_TRUE(fits(slanted_ring(n), 100 * n)) << n;
    EXPECT_TRUE(fits(cone(n), 40 * n)) << n;
  }
}

TEST(TrianglePairs, FindsWhatChangedTrianglesMeetUpdateAfterUpdate) {
  constexpr unsigned seed = 37;
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  for (const std::uint32_t hubs : {1U, 3U, 40U}) {
    Mesh mesh = random_fans(random, hubs, 300, 1);
    TrianglePairs pairs(corners_of(mesh), mesh.faces, mesh.points.size());
    for (int round = 0; round < 6; ++round) {
      Mesh moved = mesh;
      for (std::size_t i = 0; i < 5; ++i)
        moved.points[random() % moved.points.size()][i % 3] += 0.37;
      const std::vector<Corners> before = corners_of(mesh);
      const std::vector<Corners> triangles = corners_of(moved);
      std::vector<std::uint32_t> changed;
      for (std::uint32_t t = 0; t < triangles.size(); ++t)
        if (triangles[t] != before[t]) changed.push_back(t);
      pairs.update(changed, triangles, mesh.faces);
      Pairs found;
      pairs.for_each_changed([&](std::uint32_t i, std::uint32_t j) {
        if (triangles_meet(triangles[i], triangles[j])) found.emplace_back(std::minmax({i, j}));
      });
      std::ranges::sort(found);
      Pairs expected = meeting_by_all_pairs(triangles);
      std::erase_if(expected, [&](const auto& pair) {
        return !std::ranges::binary_search(changed, pair.first) &&
               !std::ranges::binary_search(changed, pair.second);
      });
      EXPECT_EQ(found, expected) << hubs << ' ' << round;
      mesh = moved;
    }
  }
}

TEST(TrianglePairs, TestsAFewPairsWhereOneTriangleOfAFanChanged) {
  constexpr std::uint32_t n = 8000;
  Mesh mesh = cone(n);
  TrianglePairs pairs(corners_of(mesh), mesh.faces, mesh.points.size());
  mesh.points[7][2] = 0.1;
  pairs.update(std::vector{5U, 6U}, corners_of(mesh), mesh.faces);
  std::size_t tested = 0;
  pairs.for_each_changed([&](std::uint32_t, std::uint32_t) { ++tested; });
  EXPECT_GT(tested, 0U);
  EXPECT_LT(tested, 100U);
}

TEST(TrianglePairs, TestsAFewPairsWhereThinTrianglesMovedAndCameBack) {
  const Mesh ring = slanted_ring(8000);
  TrianglePairs pairs(corners_of(ring), ring.faces, ring.points.size());
  Mesh moved = ring;
  moved.points[2] = {0, 0, 0.5};
  const std::vector<std::uint32_t> changed{0, 1, 2};
  pairs.update(changed, corners_of(moved), ring.faces);
  pairs.update(changed, corners_of(ring), ring.faces);
  std::size_t tested = 0;
  pairs.for_each_changed([&](std::uint32_t, std::uint32_t) { ++tested; });
  EXPECT_GT(tested, 0U);
  EXPECT_LT(tested, 500U);
}

/// So many that their branches are made apart from each other.
TEST(TrianglePairs, FindsWhatAFewMeetAmongMany) {
  constexpr unsigned seed = 41;
  SCOPED_TRACE(seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution place(-10.0, 10.0);
  std::uniform_real_distribution height(0.9, 1.7);
  Mesh mesh = slanted_both_ways(8000);
  const Mesh fan = cone(9000);
  const auto add = [&mesh](const Mesh& other) {
    const auto first = static_cast<std::uint32_t>(mesh.points.size());
    mesh.points.insert(mesh.points.end(), other.points.begin(), other.points.end());
    for (const auto& [a, b, c] : other.faces)
      mesh.faces.push_back({first + a, first + b, first + c});
  };
  add(fan);
  const std::size_t many = mesh.faces.size();
  for (int i = 0; i < 4; ++i) {
    Mesh one;
    for (int corner = 0; corner < 3; ++corner)
      one.points.push_back({place(random), place(random), height(random)});
    one.faces = {{0, 1, 2}};
    add(one);
  }
  Pairs found = meeting_by_tree(mesh).second;
  std::erase_if(found, [&](const auto& pair) { return pair.second < many; });
  const std::vector<Corners> triangles = corners_of(mesh);
  Pairs expected;
  for (std::uint32_t i = 0; i < triangles.size(); ++i)
    for (auto j = std::max(i + 1, static_cast<std::uint32_t>(many)); j < triangles.size(); ++j)
      if (triangles_meet(triangles[i], triangles[j])) expected.emplace_back(i, j);
  EXPECT_GT(expected.size(), 4U);
  EXPECT_EQ(found, expected);
}

TEST(TrianglePairs, StopsAtThePairThatFails) {
  const Mesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, std::vector(50, std::array{0U, 1U, 2U})};
  int count = 0;
  const std::vector<Corners> triangles = corners_of(mesh);
  EXPECT_FALSE(TrianglePairs(triangles, mesh.faces, mesh.points.size())
                   .all_of([&](std::uint32_t, std::uint32_t) { return ++count < 7; }));
  EXPECT_EQ(count, 7);
}

}  // namespace
}  // namespace loft
