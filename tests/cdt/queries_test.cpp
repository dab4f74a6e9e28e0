// SPDX-License-Identifier: MIT
#include "cdt/queries.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "cdt/predicates.h"
#include "tests/cdt/constraints.h"
#include "tests/cdt/edits.h"
#include "tests/cdt/random_edits.h"

namespace loft::cdt {
namespace {

using Points = std::vector<Point>;

// --- The same by brute force ---

VertexId nearest_by_looking_at_all(const Triangulation& mesh, Point p) {
  VertexId nearest;
  for (std::uint32_t i = 1; i < mesh.vertex_bound(); ++i) {
    const VertexId v(i);
    if (!mesh.is_vertex(v)) continue;
    const int order =
        nearest.is_none() ? -1 : compare_distances(p, mesh.point(v), mesh.point(nearest));
    if (order < 0 || (order == 0 && mesh.point(v) < mesh.point(nearest))) nearest = v;
  }
  return nearest;
}

/// Two open convex sets meet unless the line of an edge of one has them on different sides.
bool passes(const Triangulation& mesh, TriangleId t, Point a, Point b) {
  if (a == b) return false;
  bool is_left = false;
  bool is_right = false;
  for (unsigned k = 0; k < 3; ++k) {
    const EdgeId e = Triangulation::edge(t, k);
    const Point p = mesh.point(mesh.from(e));
    const Point q = mesh.point(mesh.to(e));
    if (orient(p, q, a) <= 0 && orient(p, q, b) <= 0) return false;
    is_left = is_left || orient(a, b, p) > 0;
    is_right = is_right || orient(a, b, p) < 0;
  }
  return is_left && is_right;
}

std::vector<TriangleId> passed_by_looking_at_all(const Triangulation& mesh, Point a, Point b) {
  std::vector<TriangleId> passed;
  for (std::uint32_t i = 0; i < mesh.triangle_bound(); ++i) {
    const TriangleId t(i);
    if (mesh.is_triangle(t) && !mesh.is_infinite(t) && passes(mesh, t, a, b)) passed.push_back(t);
  }
  return passed;
}

/// Whether a segment from a that passes both triangles is in s first: an edge of one of them has
/// them on different sides.
bool is_before(const Triangulation& mesh, TriangleId s, TriangleId t, Point a) {
  const auto is_left_first = [&](TriangleId inner, TriangleId outer, bool& is_known) {
    for (unsigned k = 0; k < 3; ++k) {
      const EdgeId e = Triangulation::edge(inner, k);
      const Point p = mesh.point(mesh.from(e));
      const Point q = mesh.point(mesh.to(e));
      is_known = true;
      for (unsigned i = 0; i < 3; ++i)
        if (orient(p, q, mesh.point(mesh.from(Triangulation::edge(outer, i)))) > 0)
          is_known = false;
      if (is_known) return orient(p, q, a) > 0;
    }
    return false;
  };
  bool is_known = false;
  const bool first = is_left_first(s, t, is_known);
  return is_known ? first : !is_left_first(t, s, is_known);
}

void expect_right_nearest(const Triangulation& mesh, Point p) {
  ASSERT_EQ(nearest_vertex(mesh, p), nearest_by_looking_at_all(mesh, p)) << p;
}

bool has_corner(const Triangulation& mesh, TriangleId t, VertexId v) {
  for (unsigned corner = 0; corner < 3; ++corner)
    if (mesh.from(Triangulation::edge(t, corner)) == v) return true;
  return false;
}

/// Each part leads to the next, over an edge that the segment crosses or a vertex on it.
void expect_joined(const Triangulation& mesh, Point a, Point b) {
  const Way way = passed_by(mesh, a, b);
  const auto side = [&](VertexId v) { return orient(a, b, mesh.point(v)); };
  const auto starts_at = [&](const WayPart& part, VertexId v) {
    return part.triangle.is_none() ? mesh.from(part.along) == v
                                   : has_corner(mesh, part.triangle, v);
  };
  if (!way.entry.is_none()) {
    ASSERT_EQ(mesh.apex(way.entry), Triangulation::infinite);
    ASSERT_EQ(way.parts.at(0).triangle, Triangulation::triangle(mesh.twin(way.entry)));
  }
  if (!way.start.is_none()) {
    ASSERT_EQ(side(way.start), 0);
    ASSERT_TRUE(way.parts.empty() || starts_at(way.parts[0], way.start));
  }
  for (std::size_t i = 0; i < way.parts.size(); ++i) {
    const WayPart& part = way.parts[i];
    ASSERT_NE(part.triangle.is_none(), part.along.is_none());
    const bool is_last = i + 1 == way.parts.size();
    if (!part.exit.is_none()) {
      ASSERT_EQ(Triangulation::triangle(part.exit), part.triangle);
      ASSERT_LT(side(mesh.from(part.exit)) * side(mesh.to(part.exit)), 0);
      const TriangleId beyond = Triangulation::triangle(mesh.twin(part.exit));
      ASSERT_TRUE(is_last ? mesh.is_infinite(beyond) : way.parts[i + 1].triangle == beyond);
    } else if (!part.end.is_none()) {
      ASSERT_EQ(side(part.end), 0);
      ASSERT_TRUE(is_last || starts_at(way.parts[i + 1], part.end));
    } else {
      ASSERT_TRUE(is_last);
    }
  }
}

void expect_right_passed(const Triangulation& mesh, Point a, Point b) {
  std::vector<TriangleId> passed = crossed_triangles(mesh, a, b);
  for (std::size_t i = 1; i < passed.size(); ++i)
    ASSERT_TRUE(is_before(mesh, passed[i - 1], passed[i], a)) << a << b << ", " << i;
  std::ranges::sort(passed);
  ASSERT_EQ(passed, passed_by_looking_at_all(mesh, a, b)) << a << b;
  ASSERT_NO_FATAL_FAILURE(expect_joined(mesh, a, b)) << a << b;
}

// --- Triangulations and places to ask about ---

Triangulation played(const Script& script) {
  Constraints constraints;
  for (const Edit& edit : script)
    if (applies(edit, constraints)) carry_out(edit, constraints);
  Triangulation mesh;
  for (const auto& [name, outline] : constraints) mesh.insert(outline.points, outline.ends);
  return mesh;
}

Triangulation grid(std::size_t n) {
  Triangulation mesh;
  for (std::size_t x = 0; x < n; ++x)
    for (std::size_t y = 0; y < n; ++y)
      mesh.insert(Point{static_cast<double>(x), static_cast<double>(y)});
  return mesh;
}

/// Vertices, middles of edges and of triangles, places beyond the hull, and others.
Points places_of_interest(const Triangulation& mesh, std::mt19937_64& random, std::size_t count) {
  Box box;
  std::vector<EdgeId> edges;
  for (std::uint32_t i = 0; i < mesh.edge_bound(); ++i) {
    const EdgeId e(i);
    if (!mesh.is_triangle(Triangulation::triangle(e)) || mesh.from(e) == Triangulation::infinite ||
        mesh.to(e) == Triangulation::infinite)
      continue;
    edges.push_back(e);
    box.add(mesh.point(mesh.from(e)));
  }
  if (edges.empty()) return {{0, 0}, {1, 2}};
  const auto fraction = [&] { return static_cast<double>(random() % 1024) / 1024; };
  Points places;
  while (places.size() < count) {
    const EdgeId e = edges[random() % edges.size()];
    const Point a = mesh.point(mesh.from(e));
    const Point b = mesh.point(mesh.to(e));
    const VertexId apex = mesh.apex(e);
    const Point c = apex == Triangulation::infinite ? a : mesh.point(apex);
    switch (random() % 5) {
      case 0:
        places.push_back(a);
        break;
      case 1:
        places.push_back({(a.x + b.x) / 2, (a.y + b.y) / 2});
        break;
      case 2:
        places.push_back({(a.x + b.x + c.x) / 3, (a.y + b.y + c.y) / 3});
        break;
      case 3:  // on the line of an edge
        places.push_back({2 * a.x - b.x, 2 * a.y - b.y});
        break;
      default:
        places.push_back({box.low.x + (3 * fraction() - 1) * (box.high.x - box.low.x),
                          box.low.y + (3 * fraction() - 1) * (box.high.y - box.low.y)});
    }
  }
  return places;
}

template <class Ask>
void ask_everywhere(Ask ask) {
  for (const Ground ground : all_grounds) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      const Triangulation mesh = played(random_script(seed, ground, 30, 10));
      std::mt19937_64 random(seed);
      SCOPED_TRACE(std::string(name_of(ground)) + ", seed " + std::to_string(seed));
      ask(mesh, random);
      if (testing::Test::HasFatalFailure()) return;
    }
  }
}

// --- The nearest vertex ---

TEST(NearestVertex, IsTheNearestWhateverIsBetween) {
  ask_everywhere([](const Triangulation& mesh, std::mt19937_64& random) {
    for (const Point p : places_of_interest(mesh, random, 100)) expect_right_nearest(mesh, p);
  });
}

TEST(NearestVertex, OfSeveralIsTheFirstByCoordinates) {
  const Triangulation mesh = grid(9);
  for (int x = -8; x < 28; ++x)
    for (int y = -8; y < 28; ++y) expect_right_nearest(mesh, {x / 2.0, y / 2.0});
  EXPECT_EQ(mesh.point(nearest_vertex(mesh, {3.5, 4.5})), (Point{3, 4}));
}

TEST(NearestVertex, IsFoundFarAway) {
  std::mt19937_64 random(7);
  Triangulation mesh;
  for (std::size_t i = 0; i < 300; ++i) {
    const double angle = static_cast<double>(i) / 17;
    mesh.insert(Point{std::cos(angle) * 100, std::sin(angle)});
  }
  for (std::size_t i = 0; i < 300; ++i) {
    const double angle = static_cast<double>(random() % 1000);
    const double radius = std::exp2(static_cast<double>(random() % 40));
    expect_right_nearest(mesh, {radius * std::cos(angle), radius * std::sin(angle)});
  }
}

TEST(NearestVertex, MayBeHardlyBehindALongEdge) {
  // The nearest vertex is hardly nearer than another, and the edge before it hardly nearer than
  // that: less than what rounding makes of the distance to a long edge.
  std::mt19937_64 random(3);
  const auto part = [&] { return static_cast<double>(random() % 1000000 + 1) / 1000000; };
  for (std::size_t i = 0; i < 2000; ++i) {
    const Point a{-part(), -part()};
    const Point b{part(), part()};
    const double along = part();
    const Point foot{a.x + along * (b.x - a.x), a.y + along * (b.y - a.y)};
    const double off = std::exp2(-10 - static_cast<double>(random() % 20));
    const double sign = i % 2 == 0 ? 1 : -1;
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    const Point normal{-sign * off * (b.y - a.y) / length, sign * off * (b.x - a.x) / length};
    Triangulation mesh;
    mesh.insert(Points{a, b}, open);
    mesh.insert(foot);
    mesh.insert(Point{foot.x + 2 * normal.x, foot.y + 2 * normal.y});
    expect_right_nearest(mesh, {foot.x + normal.x, foot.y + normal.y});
    if (HasFatalFailure()) return;
  }
}

TEST(NearestVertex, WithoutTrianglesIsFoundToo) {
  Triangulation mesh;
  EXPECT_TRUE(nearest_vertex(mesh, {1, 2}).is_none());
  const VertexId only = mesh.insert(Point{5, 5});
  EXPECT_EQ(nearest_vertex(mesh, {1, 2}), only);
  EXPECT_EQ(nearest_vertex(mesh, {5, 5}), only);
  for (const double x : {9.0, 2.0, 4.0, 7.0}) {
    mesh.insert(Point{x, x});
    for (int p = 0; p < 24; ++p)
      for (int q = 0; q < 24; ++q) expect_right_nearest(mesh, {p / 2.0, q / 2.0});
  }
}

// --- The triangles that a segment passes ---

TEST(CrossedTriangles, AreAllThatTheSegmentPasses) {
  ask_everywhere([](const Triangulation& mesh, std::mt19937_64& random) {
    const Points places = places_of_interest(mesh, random, 24);
    for (const Point a : places)
      for (const Point b : places) expect_right_passed(mesh, a, b);
  });
}

TEST(CrossedTriangles, OfAGridAreThoseOfEveryDirection) {
  const Triangulation mesh = grid(5);
  for (int a = -1; a <= 9; ++a)
    for (int b = -1; b <= 9; ++b)
      for (int c = -1; c <= 9; ++c)
        for (int d = -1; d <= 9; ++d)
          expect_right_passed(mesh, {a / 2.0, b / 2.0}, {c / 2.0, d / 2.0});
}

TEST(CrossedTriangles, AreNoneAlongEdgesAndWhereThereAreNone) {
  const Triangulation mesh = grid(4);
  EXPECT_TRUE(crossed_triangles(mesh, {0, 1}, {3, 1}).empty());
  EXPECT_TRUE(crossed_triangles(mesh, {-1, 0}, {7, 0}).empty());
  EXPECT_TRUE(crossed_triangles(mesh, {1.25, 1.5}, {1.25, 1.5}).empty());
  EXPECT_TRUE(crossed_triangles(mesh, {-1, 1}, {1, -1}).empty());
  Triangulation flat;
  EXPECT_TRUE(crossed_triangles(flat, {0, 0}, {1, 1}).empty());
  for (const double x : {1.0, 4.0, 2.0}) {
    flat.insert(Point{x, x});
    for (const Point a : {Point{0, 0}, {1, 1}, {1.5, 1.5}, {3, 0}, {9, 9}})
      for (const Point b : {Point{0, 0}, {1, 1}, {1.5, 1.5}, {0, 3}, {9, 9}})
        EXPECT_TRUE(crossed_triangles(flat, a, b).empty());
  }
}

TEST(CrossedTriangles, ThroughManyVerticesNeedNoStack) {
  Triangulation mesh;
  Points low;
  Points middle;
  Points high;
  for (int i = 0; i < 200000; ++i) {
    low.push_back({i + 0.5, -1.0});
    middle.push_back({1.0 * i, 0});
    high.push_back({i + 0.5, 1.0});
  }
  mesh.insert(std::vector<Polyline>{{low, open}, {middle, open}, {high, open}});
  EXPECT_EQ(crossed_triangles(mesh, {-5, 0}, {3e5, 0}).size(), 1U);  // the one at the end
  EXPECT_GT(crossed_triangles(mesh, {-5, 0.5}, {3e5, 0.5}).size(), 399990U);
}

TEST(BoundingBox, IsAroundAllVertices) {
  Triangulation mesh;
  EXPECT_TRUE(bounding_box(mesh).is_empty());
  mesh.insert(Point{3, -1});
  const VertexId gone = mesh.insert(Point{9, 9});
  mesh.insert(Point{-2, 4});
  mesh.remove(gone);
  EXPECT_EQ(bounding_box(mesh).low, Point(-2, -1));
  EXPECT_EQ(bounding_box(mesh).high, Point(3, 4));
}

}  // namespace
}  // namespace loft::cdt
