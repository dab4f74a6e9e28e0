// SPDX-License-Identifier: MIT
#include "mesh/meeting_faces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <random>
#include <vector>

#include "mesh/check.h"
#include "mesh/predicates.h"
#include "tests/cases.h"

namespace loft {
namespace {

constexpr std::size_t all = 1'000'000'000;

std::vector<std::uint32_t> faces_with_area(const Mesh& mesh) {
  std::vector<std::uint32_t> result;
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
    const auto [a, b, c] = corners(mesh, f);
    if (!collinear(a, b, c)) result.push_back(f);
  }
  return result;
}

std::vector<FacePair> meeting_by_all_pairs(const Mesh& mesh) {
  const std::vector<std::uint32_t> faces = faces_with_area(mesh);
  std::vector<FacePair> result;
  for (std::size_t i = 0; i < faces.size(); ++i)
    for (std::size_t j = i + 1; j < faces.size(); ++j)
      if (triangles_meet(corners(mesh, faces[i]), corners(mesh, faces[j])))
        result.emplace_back(faces[i], faces[j]);
  return result;
}

void run_backwards(std::size_t count, const std::function<void(std::size_t i)>& task) {
  while (count > 0) task(--count);
}

std::vector<FacePair> meeting(const Mesh& mesh) {
  return meeting_faces(mesh, faces_with_area(mesh), all);
}

/// A grid of squares around a torus that is crumpled by some of their size, at places in steps of
/// `step`: rounded to few digits many faces touch, fold and lose their area.
Mesh crumpled_torus(std::mt19937& random, std::uint32_t size, double amount, double step) {
  std::uniform_real_distribution<double> any(-amount / size, amount / size);
  Mesh mesh;
  const auto rounded = [&](double x) { return std::round((x + any(random)) / step) * step; };
  for (std::uint32_t i = 0; i < size; ++i)
    for (std::uint32_t j = 0; j < size; ++j) {
      const double u = 2 * std::numbers::pi * i / size;
      const double v = 2 * std::numbers::pi * j / size;
      const double radius = 1 + 0.4 * std::cos(v);
      mesh.points.push_back({rounded(radius * std::cos(u)), rounded(radius * std::sin(u)),
                             rounded(0.4 * std::sin(v))});
    }
  const auto at = [&](std::uint32_t i, std::uint32_t j) { return i % size * size + j % size; };
  for (std::uint32_t i = 0; i < size; ++i)
    for (std::uint32_t j = 0; j < size; ++j) {
      mesh.faces.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.faces.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return mesh;
}

TEST(MeetingFaces, AreThoseThatTheExactTestFinds) {
  std::size_t found = 0;
  for (std::uint32_t seed = 0; seed < cases(60); ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const double amount = std::ldexp(1, static_cast<int>(seed % 6) - 3);
    const double step = std::ldexp(1, -2 - static_cast<int>(seed % 11));
    const Mesh mesh = crumpled_torus(random, 10, amount, step);
    const std::vector<FacePair> expected = meeting_by_all_pairs(mesh);
    ASSERT_EQ(meeting(mesh), expected);
    ASSERT_EQ(meeting_faces(mesh, faces_with_area(mesh), all, run_backwards), expected);
    found += expected.size();
  }
  EXPECT_GT(found, cases(60) * 20);
}

TEST(MeetingFaces, AreFoundWithBoundariesAndFaceOnFace) {
  for (std::uint32_t seed = 0; seed < cases(60); ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    Mesh mesh = crumpled_torus(random, 8, 0.5, 0x1p-6);
    std::shuffle(mesh.faces.begin(), mesh.faces.end(), random);
    mesh.faces.resize(100);
    for (std::uint32_t i = 0; i < 10; ++i) mesh.faces.push_back(mesh.faces[7 * i]);
    for (std::uint32_t i = 0; i < 10; ++i) std::swap(mesh.faces[i][0], mesh.faces[i][1]);
    ASSERT_EQ(meeting(mesh), meeting_by_all_pairs(mesh));
  }
}

TEST(MeetingFaces, StopWhereThereAreEnough) {
  std::mt19937 random(1);
  const Mesh mesh = crumpled_torus(random, 10, 2, 0x1p-6);
  const std::vector<std::uint32_t> faces = faces_with_area(mesh);
  const std::vector<FacePair> found = meeting_faces(mesh, faces, 10);
  EXPECT_EQ(found.size(), 10U);
  for (const auto& [f, g] : found) EXPECT_TRUE(triangles_meet(corners(mesh, f), corners(mesh, g)));
}

TEST(MeetingFaces, AreFoundAmongLongThinOnesSideBySide) {
  // Slanted in all directions: each box meets all others.
  constexpr std::uint32_t count = 2000;
  Mesh mesh;
  for (std::uint32_t i = 0; i < count; ++i) {
    const double x = i * 1e-3;
    const double lean = i == 1000 ? 0.0015 : 0;
    mesh.points.insert(mesh.points.end(), {{x, 0, 0}, {x + 5e-4, 0, 0}, {x + 9 + lean, 9, 9}});
    mesh.faces.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  EXPECT_EQ(meeting(mesh), meeting_by_all_pairs(mesh));
  EXPECT_FALSE(meeting(mesh).empty());
}

TEST(MeetingFaces, DoNotMindPlacesThatNoFaceHas) {
  Mesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0.2, 0.2, -1}, {0.3, 0.2, 1}, {0.2, 0.3, 1}},
            {{0, 1, 2}, {3, 4, 5}}};
  mesh.points.push_back({INFINITY, NAN, 0});
  EXPECT_EQ(meeting(mesh), (std::vector<FacePair>{{0, 1}}));
  EXPECT_TRUE(meeting_faces(mesh, {}, all).empty());
}

/// A cone of triangles around the first vertex.
Mesh cone(const std::vector<Vec3>& ring) {
  Mesh mesh;
  mesh.points.push_back({0, 0, 0});
  mesh.points.insert(mesh.points.end(), ring.begin(), ring.end());
  const auto count = static_cast<std::uint32_t>(ring.size());
  for (std::uint32_t i = 0; i < count; ++i) mesh.faces.push_back({0, 1 + i, 1 + (i + 1) % count});
  return mesh;
}

bool is_first_tidy(const Mesh& mesh) {
  return detail::find_tidy_vertices(mesh, faces_with_area(mesh))[0] != 0;
}

TEST(TidyVertices, HaveFacesThatDoNotMeet) {
  std::size_t tidy = 0;
  std::size_t others = 0;
  for (std::uint32_t seed = 0; seed < cases(20'000); ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    // On a coarse lattice, so that much is in one plane or line.
    std::uniform_int_distribution place(-2, 2);
    std::vector<Vec3> ring;
    for (std::uint32_t i = 0; i < 3 + seed % 5; ++i)
      ring.push_back({1.0 * place(random), 1.0 * place(random), 1.0 * place(random)});
    if (seed % 2 == 0)
      std::ranges::sort(ring, {}, [](const Vec3& p) { return std::atan2(p[1], p[0]); });
    const Mesh mesh = cone(ring);
    if (!is_first_tidy(mesh)) {
      ++others;
      continue;
    }
    ++tidy;
    ASSERT_TRUE(meeting_by_all_pairs(mesh).empty());
  }
  EXPECT_GT(tidy, cases(20'000) / 100);
  EXPECT_GT(others, cases(20'000) / 100);
}

TEST(TidyVertices, AreNotThoseThatFacesGoAroundTwice) {
  std::vector<Vec3> ring;
  for (int i = 0; i < 10; ++i) {
    const double angle = 4 * std::numbers::pi * i / 10 + 0.1;
    ring.push_back({std::cos(angle), std::sin(angle), 0.1 * i});
  }
  EXPECT_FALSE(is_first_tidy(cone(ring)));
  ring.resize(5);
  EXPECT_TRUE(is_first_tidy(cone(ring)));
  Mesh open = cone(ring);
  open.faces.pop_back();
  EXPECT_FALSE(is_first_tidy(open));
}

}  // namespace
}  // namespace loft
