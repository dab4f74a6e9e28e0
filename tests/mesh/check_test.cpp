// SPDX-License-Identifier: MIT
#include "mesh/check.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "mesh/predicates.h"
#include "tests/mesh/shapes.h"

namespace loft {
namespace {

using shapes::cube;
using shapes::flipped;
using shapes::moved;
using shapes::operator+;
using shapes::tetrahedron;
using shapes::torus;

using Counts = std::map<std::string, int>;
using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

Counts faults(const Mesh& mesh) {
  Counts counts;
  for (const Finding& finding : check(mesh)) ++counts[name(finding.fault)];
  return counts;
}

/// Two vertices become one, by index.
Mesh welded(Mesh mesh, std::uint32_t keep, std::uint32_t drop) {
  for (auto& face : mesh.faces) std::ranges::replace(face, drop, keep);
  return mesh;
}

TEST(Check, FindsNothingInSolids) {
  EXPECT_EQ(faults({}), Counts{});
  EXPECT_EQ(faults(cube({0, 0, 0}, 1)), Counts{});
  EXPECT_EQ(faults(cube({5e6, -5e6, 5e6}, 1e-3)), Counts{});
  EXPECT_EQ(faults(torus(3, 1, 40, 20)), Counts{});
  EXPECT_EQ(faults(tetrahedron({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1e-9})), Counts{});
}

TEST(Check, IgnoresVerticesThatNoFaceUses) {
  Mesh mesh = cube({0, 0, 0}, 1);
  mesh.points.push_back({0.5, 0.5, 0.5});
  EXPECT_EQ(faults(mesh), Counts{});
}

TEST(Check, FindsNothingInNestedShellsThatAlternate) {
  const Mesh shell = cube({-4, -4, -4}, 8) + flipped(cube({-3, -3, -3}, 6));
  EXPECT_EQ(faults(shell), Counts{});
  EXPECT_EQ(faults(shell + cube({-2, -2, -2}, 4) + flipped(cube({-1, -1, -1}, 2))), Counts{});
  EXPECT_EQ(faults(shell + cube({10, 0, 0}, 1)), Counts{});
}

TEST(Check, FindsNothingWhereSeparateSolidsTouchInCornersAndEdges) {
  const Mesh one = cube({0, 0, 0}, 1);
  EXPECT_EQ(faults(one + cube({1, 1, 1}, 1)), Counts{});
  EXPECT_EQ(faults(one + cube({1, 1, 0}, 1)), Counts{});
}

TEST(Check, FindsNothingInACavityThatTouchesItsShellInACorner) {
  EXPECT_EQ(
      faults(cube({0, 0, 0}, 4) + flipped(tetrahedron({0, 0, 0}, {2, 1, 1}, {1, 2, 1}, {1, 1, 2}))),
      Counts{});
}

TEST(Check, DecidesNestingWhereAllCornersAreShared) {
  // The tetrahedron of every other corner of a cube, as a cavity: its edges would lie in the faces,
  // so the cube bulges: each face is a pyramid over an edge of the tetrahedron.
  const Vec3 a{0, 0, 0}, b{1, 1, 0}, c{1, 0, 1}, d{0, 1, 1};
  const Mesh cavity = tetrahedron(a, b, c, d);
  Mesh shell = cube({0, 0, 0}, 1);
  const std::vector<std::array<std::uint32_t, 4>> quads = {
      {0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  shell.faces.clear();
  for (const auto& quad : quads) {
    Vec3 top{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (const std::uint32_t v : quad) top[axis] += shell.points[v][axis] / 4;
      top[axis] += (top[axis] - 0.5) / 4;
    }
    const auto apex = static_cast<std::uint32_t>(shell.points.size());
    shell.points.push_back(top);
    for (std::size_t i = 0; i < 4; ++i) shell.faces.push_back({quad[i], quad[(i + 1) % 4], apex});
  }
  ASSERT_EQ(faults(shell), Counts{});
  const int volume_sign = orient3d(a, b, c, d);
  const Mesh inward = volume_sign > 0 ? flipped(cavity) : cavity;
  EXPECT_EQ(faults(shell + inward), Counts{});
  EXPECT_EQ(faults(shell + flipped(inward)), (Counts{{"inside_out", 1}}));
}

TEST(Contacts, AreCountedByPlace) {
  const Mesh one = cube({0, 0, 0}, 1);
  EXPECT_EQ(contacts(one), Contacts{});
  EXPECT_EQ(contacts(one + cube({1, 1, 1}, 1)), (Contacts{1, 0, {1, 1, 1}}));
  const Mesh along_an_edge = one + cube({1, 1, 0}, 1);
  EXPECT_EQ(contacts(along_an_edge), (Contacts{2, 1, {1, 1, 0}}));
  EXPECT_EQ(contacts(along_an_edge + cube({1, -1, 0}, 1)), (Contacts{4, 2, {1, 0, 0}}));
  EXPECT_EQ(contacts(one + cube({5, 5, 5}, 1)), Contacts{});
}

TEST(Check, FindsBadIndices) {
  Mesh mesh = cube({0, 0, 0}, 1);
  mesh.faces.push_back({0, 1, 8});
  const std::vector<Finding> findings = check(mesh);
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_EQ(findings[0].fault, Fault::bad_index);
  EXPECT_EQ(findings[0].faces, std::vector<std::uint32_t>{12});
}

TEST(Check, FindsCoordinatesThatAreNotFinite) {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    Mesh mesh = cube({0, 0, 0}, 1);
    mesh.points[3][1] = bad;
    const std::vector<Finding> findings = check(mesh);
    ASSERT_EQ(findings.size(), 1U);
    EXPECT_EQ(findings[0].fault, Fault::not_finite);
    EXPECT_EQ(findings[0].vertices, std::vector<std::uint32_t>{3});
  }
}

TEST(Check, FindsFacesWithoutArea) {
  Mesh mesh = cube({0, 0, 0}, 1);
  // Splits edge 0-1 for one of its faces only, and fills the gap with a triangle in one line.
  // The face across the edge now shares half of it with each of two others.
  mesh.points.push_back({0.5, 0, 0});
  mesh.faces[0] = {0, 2, 8};
  mesh.faces.push_back({8, 2, 1});
  mesh.faces.push_back({0, 8, 1});
  EXPECT_EQ(faults(mesh), (Counts{{"degenerate_face", 1}, {"self_intersection", 2}}));
  mesh.faces.push_back({4, 4, 5});
  EXPECT_EQ(faults(mesh), (Counts{{"degenerate_face", 2}, {"self_intersection", 2}}));
}

TEST(Check, FindsTheEdgesOfAHole) {
  Mesh mesh = cube({0, 0, 0}, 1);
  mesh.faces.pop_back();
  EXPECT_EQ(faults(mesh), (Counts{{"boundary_edge", 3}}));
  const Finding finding = check(mesh).front();
  EXPECT_EQ(finding.vertices.size(), 2U);
  EXPECT_EQ(finding.faces.size(), 1U);
}

TEST(Check, FindsEdgesOfMoreThanTwoFaces) {
  const Mesh touching = cube({0, 0, 0}, 1) + cube({1, 1, 0}, 1);
  const Mesh joined = welded(welded(touching, 3, 8), 7, 12);
  EXPECT_EQ(faults(joined), (Counts{{"nonmanifold_edge", 1}}));
  EXPECT_EQ(check(joined).front().faces.size(), 4U);
}

TEST(Check, FindsVerticesOfMoreThanOneFan) {
  const Mesh touching = cube({0, 0, 0}, 1) + cube({1, 1, 1}, 1);
  const Mesh joined = welded(touching, 7, 8);
  EXPECT_EQ(faults(joined), (Counts{{"nonmanifold_vertex", 1}}));
  const Finding finding = check(joined).front();
  EXPECT_EQ(finding.vertices, std::vector<std::uint32_t>{7});
  EXPECT_EQ(finding.faces.size(), 2U);
}

TEST(Check, FacesRepeatedManyTimesTakeMemoryInProportion) {
  Mesh mesh = cube({0, 0, 0}, 1);
  const auto face = mesh.faces.front();
  for (int i = 0; i < 2000; ++i) mesh.faces.push_back(face);
  const Counts counts = faults(mesh);
  EXPECT_EQ(counts.at("self_intersection"), static_cast<int>(most_intersections(mesh)));
  EXPECT_FALSE(counts.contains("inside_out"));
}

TEST(Check, FindsFacesThatDisagree) {
  Mesh mesh = cube({0, 0, 0}, 1);
  std::swap(mesh.faces[4][0], mesh.faces[4][1]);
  EXPECT_EQ(faults(mesh), (Counts{{"inconsistent_edge", 3}}));
}

TEST(Check, FindsComponentsThatAreInsideOut) {
  const Mesh inner = cube({1, 1, 1}, 1);
  const Mesh outer = cube({0, 0, 0}, 3);
  EXPECT_EQ(faults(flipped(inner)), (Counts{{"inside_out", 1}}));
  EXPECT_EQ(faults(outer + inner), (Counts{{"inside_out", 1}}));
  EXPECT_EQ(faults(flipped(outer) + inner), (Counts{{"inside_out", 2}}));
  EXPECT_EQ(faults(flipped(outer) + flipped(inner)), (Counts{{"inside_out", 1}}));
  EXPECT_EQ(check(outer + inner).front().faces, std::vector<std::uint32_t>{12});
}

TEST(Check, FindsCrossingSolids) {
  const Mesh crossing = tetrahedron({0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 4}) +
                        tetrahedron({1, 1, -1}, {5, 1, -1}, {1, 5, -1}, {1, 1, 3});
  const Counts counts = faults(crossing);
  EXPECT_EQ(counts.size(), 1U);
  EXPECT_GT(counts.at("self_intersection"), 3);
}

TEST(Check, FindsSolidsThatTouchElsewhereThanInCorners) {
  const Mesh one = cube({0, 0, 0}, 2);
  EXPECT_GT(faults(one + cube({2, 0, 0}, 2))["self_intersection"], 0);  // faces on faces
  EXPECT_GT(faults(one + cube({2, 2, 1}, 2))["self_intersection"], 0);  // edges that overlap
  const Mesh corner_on_face = one + tetrahedron({2, 1, 1}, {3, 0, 0}, {3, 2, 0}, {3, 1, 2});
  EXPECT_GT(faults(corner_on_face)["self_intersection"], 0);
}

TEST(Check, FindsTheSameFaceTwice) {
  const Mesh mesh = cube({0, 0, 0}, 1) + cube({0, 0, 0}, 1);
  EXPECT_GE(faults(mesh)["self_intersection"], 12);
}

TEST(Check, SaysTheSameWhereverTheMeshIs) {
  const Mesh mesh = torus(3, 1, 24, 12) + flipped(torus(3, 0.5, 24, 12)) + cube({8, 0, 0}, 1);
  EXPECT_EQ(faults(mesh), Counts{});
  EXPECT_EQ(faults(moved(mesh, {5e6, 5e6, -5e6})), Counts{});
}

/// Random triangles over few places: every kind of meeting and touching.
Mesh random_soup(std::mt19937_64& random) {
  const auto faces = static_cast<std::uint32_t>(1 + random() % 120);
  const std::uint64_t grid = 3 + random() % 30;
  const auto coordinate = [&] { return static_cast<double>(random() % grid); };
  Mesh mesh;
  for (std::uint32_t i = 0; i < faces; ++i) {
    mesh.faces.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    for (int corner = 0; corner < 3; ++corner) {
      mesh.points.push_back({coordinate(), coordinate(), coordinate()});
    }
  }
  return mesh;
}

Pairs meeting_by_brute_force(const Mesh& mesh) {
  const auto corners = [&](std::uint32_t f) {
    return Corners{mesh.points[3 * f], mesh.points[3 * f + 1], mesh.points[3 * f + 2]};
  };
  const auto is_degenerate = [](const Corners& c) { return collinear(c[0], c[1], c[2]); };
  Pairs result;
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
    for (std::uint32_t g = f + 1; g < mesh.faces.size(); ++g) {
      if (is_degenerate(corners(f)) || is_degenerate(corners(g))) continue;
      if (triangles_meet(corners(f), corners(g))) result.emplace_back(f, g);
    }
  }
  return result;
}

TEST(Check, FindsTheSelfIntersectionsThatBruteForceFinds) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    const Mesh mesh = random_soup(random);
    Pairs found;
    for (const Finding& finding : check(mesh)) {
      if (finding.fault != Fault::self_intersection) continue;
      found.emplace_back(finding.faces[0], finding.faces[1]);
    }
    EXPECT_EQ(found, meeting_by_brute_force(mesh));
  }
}

}  // namespace
}  // namespace loft
