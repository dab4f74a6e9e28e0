// SPDX-License-Identifier: MIT
#include "cdt/triangulation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <string>

#include "cdt/predicates.h"
#include "tests/cdt/constraints.h"

namespace loft::cdt {
namespace {

Triangulation triangulate(const std::vector<OwnPolyline>& polylines) {
  Triangulation mesh;
  for (const OwnPolyline& polyline : polylines) mesh.insert(polyline.points, polyline.ends);
  return mesh;
}

std::vector<Point> circle(std::size_t n, double radius, Point centre = {}) {
  std::vector<Point> points;
  for (std::size_t i = 0; i < n; ++i) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(n);
    points.push_back({centre.x + radius * std::cos(angle), centre.y + radius * std::sin(angle)});
  }
  return points;
}

/// The Delaunay triangles by brute force: those whose circle holds no other point.
std::vector<std::array<Point, 3>> brute_force_delaunay(const std::vector<Point>& points) {
  std::vector<std::array<Point, 3>> triangles;
  for (const Point a : points) {
    for (const Point b : points) {
      for (const Point c : points) {
        if (!(a < b && a < c) || orient(a, b, c) <= 0) continue;
        const bool is_empty = std::ranges::all_of(points, [&](Point d) {
          return d == a || d == b || d == c || in_circle_perturbed(a, b, c, d) < 0;
        });
        if (is_empty) triangles.push_back({a, b, c});
      }
    }
  }
  std::ranges::sort(triangles);
  return triangles;
}

TEST(Triangulation, OfNothingIsEmpty) {
  const Triangulation mesh;
  EXPECT_EQ(mesh.vertex_count(), 0U);
  EXPECT_EQ(mesh.triangle_count(), 0U);
  EXPECT_EQ(mesh.locate({1, 2}).kind, Location::Kind::nowhere);
  EXPECT_EQ(first_fault(mesh), "");
}

TEST(Triangulation, OfPointsInOneLineHasNoFiniteTriangle) {
  std::vector<double> places{3, 1, 7, 5, 0, 9, 2};
  Triangulation mesh;
  for (const double x : places) {
    mesh.insert({x, 2 * x});
    EXPECT_EQ(first_fault(mesh), "");
  }
  EXPECT_EQ(mesh.vertex_count(), places.size());
  EXPECT_TRUE(triangles_of(mesh).empty());
  EXPECT_EQ(mesh.locate({4, 8}).kind, Location::Kind::edge);
  EXPECT_EQ(mesh.locate({5, 10}).kind, Location::Kind::vertex);
  EXPECT_EQ(mesh.locate({10, 20}).kind, Location::Kind::outside);
  EXPECT_EQ(mesh.locate({4, 9}).kind, Location::Kind::outside);

  mesh.insert({4, 0});
  EXPECT_EQ(triangles_of(mesh).size(), places.size() - 1);
  EXPECT_EQ(first_fault(mesh), "");
}

TEST(Triangulation, IsDelaunayByBruteForceWithTiesBrokenByCoordinates) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937_64 random(seed);
    std::vector<Point> points;
    for (int i = 0; i < 14; ++i)
      points.push_back({static_cast<double>(random() % 5), static_cast<double>(random() % 5)});
    std::ranges::sort(points);
    points.erase(std::unique(points.begin(), points.end()), points.end());
    const auto expected = brute_force_delaunay(points);
    for (int order = 0; order < 5; ++order) {
      std::ranges::shuffle(points, random);
      Triangulation mesh;
      for (const Point p : points) mesh.insert(p);
      EXPECT_EQ(triangles_of(mesh), expected);
    }
  }
}

TEST(Triangulation, StaysValidWhateverIsInserted) {
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    for (const Places places : all_places) {
      SCOPED_TRACE("seed " + std::to_string(seed) + " places " +
                   std::to_string(static_cast<int>(places)));
      Triangulation mesh;
      for (const OwnPolyline& polyline : random_polylines(seed, places)) {
        mesh.insert(polyline.points, polyline.ends);
        ASSERT_EQ(first_fault(mesh), "");
      }
    }
  }
}

// The last resort of a segment led astray left a loop that pieces() did not find its way out of.
TEST(Triangulation, CoversASegmentThatRoundingLedInLoops) {
  Triangulation mesh = triangulate(random_polylines(315, Places::nearly_equal));
  EXPECT_EQ(first_fault(mesh), "");
}

// In general position. Where three lines meet in nearly one point, rounding may still bend them in
// the order in which they come.
TEST(Triangulation, DoesNotDependOnTheOrderOfInsertion) {
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    auto polylines = random_polylines(seed, Places::decimals);
    const Triangulation one = triangulate(polylines);
    std::mt19937_64 random(seed);
    std::ranges::shuffle(polylines, random);
    const Triangulation other = triangulate(polylines);
    EXPECT_EQ(triangles_of(one), triangles_of(other));
  }
}

TEST(Triangulation, MakesAVertexWhereConstraintsCross) {
  Triangulation mesh;
  const auto one = mesh.insert(std::vector<Point>{{0, 0}, {4, 4}}, open);
  const auto other = mesh.insert(std::vector<Point>{{0, 2}, {4, 2}}, open);
  EXPECT_EQ(mesh.vertex_count(), 5U);
  const auto place = mesh.locate({2, 2});
  ASSERT_EQ(place.kind, Location::Kind::vertex);
  for (const ConstraintId id : {one, other}) {
    const auto pieces = mesh.pieces(mesh.first_segment(id));
    ASSERT_EQ(pieces.size(), 2U);
    EXPECT_EQ(mesh.to(pieces[0]), mesh.from(place.edge));
    for (const EdgeId e : pieces) {
      ASSERT_EQ(mesh.passages(e).size(), 1U);
      EXPECT_EQ(mesh.segment(mesh.passages(e)[0].segment()).constraint, id);
      EXPECT_TRUE(mesh.is_forward(e, mesh.passages(e)[0]));
      EXPECT_FALSE(mesh.is_forward(mesh.twin(e), mesh.passages(e)[0]));
    }
  }
}

// KBT, section 3: a segment (2,0)-(3,0) on another, (1,0)-(4,0).
TEST(Triangulation, OverlappingConstraintsShareEdges) {
  Triangulation mesh;
  const auto s = mesh.insert(std::vector<Point>{{2, 0}, {3, 0}}, open);
  const auto t = mesh.insert(std::vector<Point>{{1, 0}, {4, 0}}, open);
  mesh.insert({2.5, 1});
  EXPECT_EQ(mesh.pieces(mesh.first_segment(s)).size(), 1U);
  const auto pieces = mesh.pieces(mesh.first_segment(t));
  ASSERT_EQ(pieces.size(), 3U);
  EXPECT_EQ(mesh.passages(pieces[0]).size(), 1U);
  EXPECT_EQ(mesh.passages(pieces[1]).size(), 2U);
  EXPECT_EQ(mesh.passages(pieces[2]).size(), 1U);
}

TEST(Triangulation, KeepsEveryPassageOfAConstraintThatRepeatsItself) {
  Triangulation mesh;
  const auto spike = mesh.insert(std::vector<Point>{{0, 0}, {10, 0}, {0, 0}, {0, 5}, {0, 5}}, open);
  mesh.insert({5, 0.1});
  mesh.insert({5, -0.1});
  EXPECT_EQ(first_fault(mesh), "");
  const auto there = mesh.pieces(mesh.first_segment(spike));
  ASSERT_EQ(there.size(), 1U);
  EXPECT_EQ(mesh.passages(there[0]).size(), 2U);
  const auto segments = mesh.segments(spike);
  ASSERT_EQ(segments.size(), 4U);
  EXPECT_EQ(segments[3].from, segments[3].to);
}

TEST(Triangulation, CrossingsOfOverlappingLinesAreOneVertex) {
  // Thirty segments on one line that is no multiple of anything, all crossed by another.
  Triangulation mesh;
  for (int i = 1; i <= 30; ++i)
    mesh.insert(std::vector<Point>{{-3.0 * i, -1.0 * i}, {3.0 * i, 1.0 * i}}, open);
  mesh.insert(std::vector<Point>{{0.1, -1}, {0.3, 1}}, open);
  EXPECT_EQ(mesh.vertex_count(), 60U + 2U + 1U);
  EXPECT_EQ(first_fault(mesh), "");
}

TEST(Triangulation, SplitsEdgesAndTrianglesOnlyWhereTheyStayProper) {
  Triangulation mesh;
  mesh.insert(std::vector<Point>{{0, 0}, {4, 0}, {0, 4}}, closed);
  const TriangleId inside = Triangulation::triangle(mesh.locate({1, 1}).edge);
  EXPECT_FALSE(mesh.split(inside, {5, 5}));
  EXPECT_FALSE(mesh.split(inside, {2, 2}));
  const double no_number = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)mesh.split(inside, {no_number, 1}), std::invalid_argument);
  EXPECT_THROW((void)mesh.split(TriangleId(777), {1, 1}), std::invalid_argument);
  EXPECT_THROW((void)mesh.split(EdgeId::none(), {1, 1}), std::invalid_argument);
  ASSERT_TRUE(mesh.split(inside, {1, 1}));
  const auto edge =
      mesh.find_edge(mesh.from(mesh.locate({0, 0}).edge), mesh.from(mesh.locate({4, 0}).edge));
  ASSERT_TRUE(edge);
  EXPECT_FALSE(mesh.split(*edge, {2, 3}));
  EXPECT_THROW((void)mesh.split(*edge, {2, -1 / 0.0}), std::invalid_argument);
  ASSERT_TRUE(mesh.split(*edge, {2, 0}));
  EXPECT_EQ(mesh.pieces(SegmentId(0)).size(), 2U);
  EXPECT_EQ(first_fault(mesh), "");
}

TEST(Triangulation, SplitsALineOnlyBetweenItsEnds) {
  for (const Point place : {Point{5, 0}, Point{0, 0}, Point{-1, 0}, Point{1, 0}, Point{3, 1}}) {
    Triangulation mesh;
    const VertexId a = mesh.insert({0, 0});
    const VertexId b = mesh.insert({1, 0});
    EXPECT_FALSE(mesh.split(*mesh.find_edge(a, b), place)) << place;
    EXPECT_EQ(mesh.vertex_count(), 2U);
  }
  for (const Point place : {Point{0.5, 0}, Point{0.5, 0.1}, Point{0.2, -3}}) {
    Triangulation mesh;
    mesh.insert(std::vector<Point>{{-1, 0}, {0, 0}, {1, 0}, {2, 0}}, open);
    const auto found = mesh.locate({0.25, 0});
    ASSERT_TRUE(mesh.split(found.edge, place)) << place;
    EXPECT_EQ(first_fault(mesh), "");
    EXPECT_EQ(mesh.pieces(ConstraintId(0)).size(), 4U);
    EXPECT_EQ(mesh.snaps().empty(), place.y == 0);
  }
}

TEST(Triangulation, FindsNoEdgeOfAVertexThatIsGone) {
  Triangulation mesh;
  mesh.insert({0, 0});
  const VertexId a = mesh.insert({1, 0});
  mesh.insert({0, 1});
  const VertexId gone = mesh.insert({3, 3});
  mesh.remove(gone);
  EXPECT_FALSE(mesh.find_edge(a, gone));
  EXPECT_FALSE(mesh.find_edge(gone, a));
  EXPECT_EQ(mesh.locate({std::numeric_limits<double>::quiet_NaN(), 0}).kind,
            Location::Kind::nowhere);
}

TEST(Triangulation, RefusesWhatIsNoPolylineAndStaysAsItWas) {
  Triangulation mesh;
  mesh.insert(circle(5, 1), closed);
  const auto before = triangles_of(mesh);
  const double no_number = std::numeric_limits<double>::quiet_NaN();
  const double endless = std::numeric_limits<double>::infinity();
  EXPECT_THROW(mesh.insert(std::vector<Point>{}, open), std::invalid_argument);
  EXPECT_THROW(mesh.insert(std::vector<Point>{{3, 3}, {no_number, 0}}, open),
               std::invalid_argument);
  EXPECT_THROW(mesh.insert(std::vector<Point>{{3, 3}, {0, endless}}, open), std::invalid_argument);
  EXPECT_THROW(mesh.insert(std::vector<Point>{{3, 3}, {0, 2e75}}, open), std::invalid_argument);
  EXPECT_THROW(mesh.insert(std::vector<Point>{{3, 3}, {0, 1e-66}}, open), std::invalid_argument);
  EXPECT_EQ(triangles_of(mesh), before);
  EXPECT_EQ(mesh.constraint_count(), 1U);
}

TEST(Triangulation, IsAValue) {
  Triangulation mesh;
  mesh.insert(circle(7, 1), closed);
  Triangulation copy = mesh;
  copy.insert(circle(7, 2), closed);
  EXPECT_EQ(mesh.vertex_count(), 7U);
  EXPECT_EQ(first_fault(copy), "");
  copy.clear();
  copy.insert(circle(7, 1), closed);
  EXPECT_EQ(triangles_of(copy), triangles_of(mesh));
}

TEST(Triangulation, OfTwoLargeContoursIsValid) {
  auto wobbly = circle(3000, 1);
  for (std::size_t i = 0; i < wobbly.size(); ++i) {
    const double scale = 1 + 0.001 * std::sin(0.4 * static_cast<double>(i));
    wobbly[i] = {wobbly[i].x * scale, wobbly[i].y * scale};
  }
  Triangulation mesh;
  mesh.insert(circle(2500, 1), closed);
  mesh.insert(wobbly, closed);
  EXPECT_EQ(first_fault(mesh), "");
  EXPECT_GT(mesh.vertex_count(), 5500U + 300U);
}

// All tips of the comb's teeth are inserted before what is between them: in the order of the curve,
// that would take a flip for every two teeth.
TEST(Triangulation, InsertsALongComb) {
  const int teeth = 40'000;
  std::vector<Point> comb;
  for (int i = 0; i < teeth; ++i) {
    comb.push_back({static_cast<double>(i), 0});
    comb.push_back({i + 0.5, 10'000});
  }
  comb.push_back({static_cast<double>(teeth), -5000});
  comb.push_back({0, -5000});
  Triangulation mesh;
  mesh.insert(comb, closed);
  EXPECT_EQ(mesh.vertex_count(), comb.size());
}

// The crossing near the segment's start, rounded, is straight below it, while the segment is not
// upright: which way is ahead is not for the order of the points to say.
TEST(Triangulation, DoesNotLeadASegmentBackToItsStart) {
  Triangulation mesh;
  mesh.insert(std::array{Point{6, 2}, Point{6, 3}, Point{5, 3}}, closed);
  const Point start{5.9999999999998002, 2.0000000000006};
  const ConstraintId c = mesh.insert(std::array{start, Point{6, 1}}, open);
  const std::vector<EdgeId> pieces = mesh.pieces(c);
  ASSERT_EQ(pieces.size(), 2U);
  EXPECT_EQ(mesh.point(mesh.from(pieces[0])), start);
  EXPECT_EQ(mesh.point(mesh.to(pieces[1])), (Point{6, 1}));
  EXPECT_TRUE(mesh.snaps().empty());
}

}  // namespace
}  // namespace loft::cdt
