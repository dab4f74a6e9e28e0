// SPDX-License-Identifier: MIT
#include "reconstruct/shape/simplify.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <string>
#include <vector>

#include "mesh/measure.h"
#include "reconstruct/defect.h"
#include "reconstruct/reconstruct.h"
#include "tests/cases.h"
#include "tests/reconstruct/solid.h"
#include "tests/reconstruct/stacks.h"
#include "tests/reconstruct/triangles.h"

namespace loft {
namespace {

using solids::faults;

/// Simplifies, and expects what is promised of every result.
Surface simplified(const Surface& surface, double tolerance) {
  Surface result = surface;
  const Simplification report = simplify(result, tolerance);
  EXPECT_EQ(faults(result), faults(surface));
  EXPECT_EQ(report.removed_vertices, surface.n_vertices() - result.n_vertices());
  EXPECT_LE(report.distance, tolerance);
  const Mesh before = to_mesh(surface);
  const Mesh after = to_mesh(result);
  const double rounding = 1e-10;
  EXPECT_LE(triangles::farthest(before, after), report.distance + rounding);
  EXPECT_LE(triangles::farthest(after, before), report.distance + rounding);
  EXPECT_EQ(measure(after).genus, measure(before).genus);
  EXPECT_EQ(measure(after).components, measure(before).components);
  return result;
}

TEST(Simplify, AnExtrudedSquareBecomesTwelveTriangles) {
  std::vector<Slice> slices;
  for (const double z : {0.0, 1.0, 2.5, 7.0}) slices.push_back({z, {stacks::square(2)}});
  const Surface box = simplified(reconstruct(slices).surface, 0);
  EXPECT_EQ(box.n_faces(), 12U);
  EXPECT_EQ(box.n_vertices(), 8U);
  EXPECT_DOUBLE_EQ(measure(to_mesh(box)).volume, 16 * 7);
}

TEST(Simplify, PointsOnStraightEdgesGoWithoutTolerance) {
  Contour fine;
  for (const double x : {0.0, 1.0, 2.0, 3.0}) fine.points.push_back({x, 0});
  for (const double y : {0.0, 0.5, 4.0}) fine.points.push_back({4, y});
  fine.points.push_back({0, 4});
  const Surface box =
      simplified(reconstruct(std::vector<Slice>{{0, {fine}}, {1, {fine}}}).surface, 0);
  EXPECT_EQ(box.n_faces(), 12U);
}

TEST(Simplify, ToleranceZeroChangesNothing) {
  std::vector<Slice> tower;
  for (const double z : {0.0, 1.0, 2.0, 3.5}) tower.push_back({z, {stacks::circle(30, 1)}});
  std::vector<Slice> ends = tower;
  ends.push_back({5, {stacks::circle(20, 0.5)}});
  for (const auto& slices : {tower, ends}) {
    const Surface surface = reconstruct(slices).surface;
    const Surface result = simplified(surface, 0);
    EXPECT_LT(result.n_faces(), surface.n_faces() * 2 / 3);
    const Measures before = measure(to_mesh(surface));
    const Measures after = measure(to_mesh(result));
    EXPECT_NEAR(after.area, before.area, 1e-12 * before.area);
    EXPECT_NEAR(after.volume, before.volume, 1e-12 * before.area);
  }
}

TEST(Simplify, ASphereNeedsFewerTrianglesForALargerTolerance) {
  const Surface sphere = reconstruct(stacks::sphere(16, 40)).surface;
  std::size_t before = sphere.n_faces();
  for (const double tolerance : {0.01, 0.03, 0.1}) {
    SCOPED_TRACE(tolerance);
    const std::size_t faces = simplified(sphere, tolerance).n_faces();
    EXPECT_LT(faces, before * 3 / 4);
    before = faces;
  }
  EXPECT_LT(before, sphere.n_faces() / 5);
}

TEST(Simplify, HolesAndPartsStayWhateverTheTolerance) {
  (void)simplified(reconstruct(stacks::Torus::slices(16, 10)).surface, 100);
  (void)simplified(reconstruct(stacks::y_branch(8, 20)).surface, 100);
}

TEST(Simplify, VerticesThatStayKnowWhereTheyComeFrom) {
  const auto slices = stacks::y_branch(10, 20);
  const Surface result = simplified(reconstruct(slices).surface, 0.05);
  std::size_t contour_vertices = 0;
  for (const auto v : result.vertices()) {
    const Origin& origin = result.data(v).origin;
    if (origin.kind != VertexKind::contour) continue;
    ++contour_vertices;
    const Slice& slice = slices[origin.slice];
    const cdt::Point p = slice.contours[origin.contour].points[origin.point];
    EXPECT_EQ(result.point(v), OpenMesh::Vec3d(p.x, p.y, slice.z));
  }
  EXPECT_GT(contour_vertices, 0U);
}

TEST(Simplify, PartsThatTouchStayInTouch) {
  // Two towers that share an upright edge, with corners between that could go.
  std::vector<Slice> slices;
  for (const double z : {0.0, 1.0, 2.0})
    slices.push_back({z, {stacks::square(1), stacks::square(1, {2, 2})}});
  const Surface surface = reconstruct(slices).surface;
  const Surface result = simplified(surface, 0);
  EXPECT_LT(result.n_faces(), surface.n_faces());
  const auto count_touching = [](const Surface& s) {
    return std::ranges::count_if(s.vertices(),
                                 [&](auto v) { return s.point(v)[0] == 1 && s.point(v)[1] == 1; });
  };
  EXPECT_EQ(count_touching(result), count_touching(surface));
}

/// Rings of many points, each a little larger and turned by a little.
std::vector<Slice> rings(std::size_t points) {
  std::vector<Slice> slices;
  for (int i = 0; i < 5; ++i)
    slices.push_back({1.0 * i, {stacks::circle(points, 10 + 0.2 * i, {}, 0.01 * i)}});
  return slices;
}

std::vector<Vec3> rim_places(const Surface& surface) {
  std::vector<Vec3> places;
  for (const auto v : surface.vertices()) {
    const OpenMesh::Vec3d& p = surface.point(v);
    if (surface.is_boundary(v)) places.push_back({p[0], p[1], p[2]});
  }
  return places;
}

TEST(Simplify, DistancesDoNotAddUpAcrossLargeFaces) {
  // Each vertex of the last ring is a corner of caps: 152 of 400 stayed, for a tolerance of a tenth
  // of the radius.
  EXPECT_LE(simplified(reconstruct(rings(400)).surface, 1).n_vertices(), 60U);
}

TEST(Simplify, RimsAreKeptByTheFewestVertices) {
  // Six sides of 200 are 0.044 deep, five 0.031.
  const Surface tube = reconstruct(rings(200), {.cap = Cap::open}).surface;
  const Surface result = simplified(tube, 0.035);
  EXPECT_EQ(rim_places(tube).size(), 400U);
  EXPECT_EQ(rim_places(result).size(), 80U);
  EXPECT_LE(result.n_vertices(), 100U);
}

TEST(Simplify, RimsStayInTheirSlicesAndNearTheirCurves) {
  const Surface tube = reconstruct(stacks::sphere(12, 40), {.cap = Cap::open}).surface;
  const double tolerance = 0.05;
  const Surface result = simplified(tube, tolerance);
  std::vector<std::array<Vec3, 2>> edges;
  for (const auto h : result.halfedges()) {
    if (!result.is_boundary(h)) continue;
    const OpenMesh::Vec3d& a = result.point(result.from_vertex_handle(h));
    const OpenMesh::Vec3d& b = result.point(result.to_vertex_handle(h));
    EXPECT_EQ(a[2], b[2]);
    edges.push_back({Vec3{a[0], a[1], a[2]}, Vec3{b[0], b[1], b[2]}});
  }
  EXPECT_LT(edges.size(), rim_places(tube).size());
  for (const Vec3& p : rim_places(tube)) {
    double least = 1;
    for (const auto& [a, b] : edges) least = std::min(least, triangles::distance(p, a, b));
    EXPECT_LE(least, tolerance);
  }
}

TEST(Simplify, PointsOnStraightRimsGoWithoutTolerance) {
  Contour fine;
  for (const double x : {0.0, 1.0, 2.0, 3.0}) fine.points.push_back({x, 0});
  for (const double y : {0.0, 0.5, 4.0}) fine.points.push_back({4, y});
  fine.points.push_back({0, 4});
  const Surface tube =
      reconstruct(std::vector<Slice>{{0, {fine}}, {1, {fine}}, {2, {fine}}}, {.cap = Cap::open})
          .surface;
  EXPECT_EQ(simplified(tube, 0).n_vertices(), 8U);
}

TEST(Simplify, ThinShellsDoNotMeet) {
  // The tolerance is ten times the shell's thickness.
  std::vector<Slice> slices;
  for (int i = 0; i <= 10; ++i)
    slices.push_back({0.2 * i, {stacks::circle(40, 1), stacks::circle(37, 0.99)}});
  const Surface shell = reconstruct(slices).surface;
  const Surface result = simplified(shell, 0.1);
  EXPECT_LT(result.n_faces(), shell.n_faces());
}

TEST(Simplify, NothingPassesThroughASmallPart) {
  // A spike, and a small part beside it that is in the way when the spike goes.
  std::vector<Slice> slices;
  for (int i = 0; i <= 8; ++i) {
    const double radius = 2.0 - 0.24 * i;
    slices.push_back({1.0 * i, {stacks::circle(12, radius)}});
    if (i >= 4) slices.back().contours.push_back(stacks::circle(6, 0.05, {radius + 0.2, 0}));
  }
  const Surface surface = reconstruct(slices).surface;
  for (const double tolerance : {0.1, 0.5, 2.0, 10.0}) (void)simplified(surface, tolerance);
}

TEST(Simplify, ADentedPartDoesNotTurnInsideOut) {
  // The edge from c to e is between a and the line from b to d: a must not go through it.
  Surface surface;
  const auto a = surface.add_vertex({2, 0, 0});
  const auto b = surface.add_vertex({0, 4, 0});
  const auto c = surface.add_vertex({0.6, 0, -1.5});
  const auto d = surface.add_vertex({0, -3, 0});
  const auto e = surface.add_vertex({0.6, 0, 1.5});
  for (const auto& [i, j, k] : {std::array{a, c, b}, std::array{a, d, c}, std::array{a, e, d},
                                std::array{a, b, e}, std::array{b, c, e}, std::array{c, d, e}})
    surface.add_face(i, j, k);
  ASSERT_EQ(faults(surface), "");
  EXPECT_GT(measure(to_mesh(simplified(surface, 100))).volume, 0);
}

TEST(Simplify, AnySolidStaysOne) {
  for (std::uint64_t seed = 0; seed < cases(60); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    std::vector<Slice> slices;
    for (int i = 0; i < 3; ++i)
      slices.push_back(seed % 3 == 2 ? stacks::random_mask(i, random, 5, 0.5)
                                     : stacks::random_slice(i, random, seed % 3 == 0));
    const double tolerance = std::uniform_real_distribution<double>(0, 0.5)(random);
    try {
      (void)simplified(reconstruct(slices).surface, seed % 5 == 0 ? 0 : tolerance);
    } catch (const InputError&) {
      // Fewer than two slices with an area: rare, and right.
    }
  }
}

TEST(Simplify, NumbersOfVerticesHaveNoPartInIt) {
  const std::vector<Slice> slices = stacks::Torus::slices(10, 12);
  std::vector<Slice> renumbered = slices;
  for (Slice& slice : renumbered) {
    std::ranges::reverse(slice.contours);
    for (Contour& contour : slice.contours)
      std::rotate(contour.points.begin(), contour.points.begin() + 5, contour.points.end());
  }
  for (const double tolerance : {0.0, 0.03})
    EXPECT_EQ(triangles::by_place(reconstruct(slices, {.simplify = tolerance}).surface),
              triangles::by_place(reconstruct(renumbered, {.simplify = tolerance}).surface));
}

TEST(Simplify, IsAStageOfItsOwn) {
  std::vector<std::pair<Stage, double>> seen;
  (void)reconstruct(stacks::sphere(6, 20), {.simplify = 0.1}, [&](Stage stage, double fraction) {
    seen.emplace_back(stage, fraction);
    return true;
  });
  EXPECT_TRUE(std::ranges::is_sorted(seen));
  EXPECT_EQ(seen.back(), std::pair(Stage::simplify, 1.0));
}

}  // namespace
}  // namespace loft
