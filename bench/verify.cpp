// SPDX-License-Identifier: MIT
#include "bench/verify.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>

#include "cdt/predicates.h"

namespace loft::bench {

namespace {

using cdt::EdgeId;
using cdt::Point;
using cdt::TriangleId;
using cdt::Triangulation;
using cdt::VertexId;
using Index = PlainMesh::Index;
using Pair = std::array<Index, 2>;

Pair sorted(Index a, Index b) { return {std::min(a, b), std::max(a, b)}; }

/// An edge and the corner opposite to it in one triangle.
struct Side {
  Pair edge;
  Index apex;
  friend auto operator<=>(const Side&, const Side&) = default;
};

std::vector<Side> sides_of(const PlainMesh& mesh) {
  std::vector<Side> sides;
  sides.reserve(3 * mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    sides.push_back({sorted(a, b), c});
    sides.push_back({sorted(b, c), a});
    sides.push_back({sorted(c, a), b});
  }
  std::ranges::sort(sides);
  return sides;
}

std::vector<Pair> sorted_constrained(const PlainMesh& mesh) {
  std::vector<Pair> edges;
  edges.reserve(mesh.constrained.size());
  for (const auto& [a, b] : mesh.constrained) edges.push_back(sorted(a, b));
  std::ranges::sort(edges);
  return edges;
}

bool is_delaunay(const PlainMesh& mesh, const Side& one, const Side& other) {
  Point a = mesh.vertices[one.edge[0]];
  Point b = mesh.vertices[one.edge[1]];
  const Point c = mesh.vertices[one.apex];
  if (cdt::orient(a, b, c) < 0) std::swap(a, b);
  return cdt::in_circle(a, b, c, mesh.vertices[other.apex]) <= 0;
}

void verify_triangles(const PlainMesh& mesh, Verdict& verdict) {
  for (const auto& [a, b, c] : mesh.triangles)
    if (cdt::orient(mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]) <= 0)
      ++verdict.bad_orientation;
}

void verify_edges(const PlainMesh& mesh, Verdict& verdict) {
  const std::vector<Side> sides = sides_of(mesh);
  const std::vector<Pair> constrained = sorted_constrained(mesh);
  for (const Pair edge : constrained)
    if (!std::ranges::binary_search(sides, edge, {}, &Side::edge)) ++verdict.constrained_missing;
  for (std::size_t first = 0, end = 0; first < sides.size(); first = end) {
    while (end < sides.size() && sides[end].edge == sides[first].edge) ++end;
    if (end - first > 2) ++verdict.nonmanifold;
    if (end - first != 2 || std::ranges::binary_search(constrained, sides[first].edge)) continue;
    if (!is_delaunay(mesh, sides[first], sides[first + 1])) ++verdict.non_delaunay;
  }
}

/// Follows input segments along constrained edges.
class Coverage {
 public:
  explicit Coverage(const PlainMesh& mesh) : mesh_(mesh), ways_(mesh.constrained) {
    for (const auto& [a, b] : mesh.constrained) ways_.push_back({b, a});
    std::ranges::sort(ways_);
    for (Index v = 0; v < mesh.vertices.size(); ++v) by_place_.push_back(v);
    std::ranges::sort(by_place_, {}, [&](Index v) { return mesh.vertices[v]; });
    double extent = 0;
    for (const Point p : mesh.vertices) extent = std::max({extent, std::abs(p.x), std::abs(p.y)});
    tolerance_ = 1e-12 * extent;
  }

  [[nodiscard]] bool covers(Point a, Point b) const {
    if (a == b) return true;
    const auto start = find(a);
    const auto goal = find(b);
    if (!start || !goal) return false;
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    const Point ahead{(b.x - a.x) / length, (b.y - a.y) / length};
    // Where chains run closer than the tolerance, some of the ways on are dead ends: try them all.
    std::vector<Step> open{{*start, 0}};
    std::unordered_set<Index> seen{*start};
    while (!open.empty()) {
      const Step at = open.back();
      open.pop_back();
      if (at.vertex == *goal) return true;
      for (const Step step : steps_from(at, a, ahead, length))
        if (seen.insert(step.vertex).second) open.push_back(step);
    }
    return false;
  }

 private:
  /// A vertex, and how far along the segment it is.
  struct Step {
    Index vertex;
    double along;
  };

  [[nodiscard]] std::optional<Index> find(Point p) const {
    const auto place = [&](Index v) { return mesh_.vertices[v]; };
    const auto found = std::ranges::lower_bound(by_place_, p, {}, place);
    if (found == by_place_.end() || place(*found) != p) return {};
    return *found;
  }

  /// The vertices on the segment, but for the tolerance, that constrained edges lead to from `at`,
  /// the nearest last. None is behind by more than the tolerance.
  [[nodiscard]] std::vector<Step> steps_from(Step at, Point start, Point ahead,
                                             double length) const {
    std::vector<Step> steps;
    for (auto way = std::ranges::lower_bound(ways_, Pair{at.vertex, 0});
         way != ways_.end() && way->front() == at.vertex; ++way) {
      const Index to = way->back();
      const Point offset{mesh_.vertices[to].x - start.x, mesh_.vertices[to].y - start.y};
      const double along = offset.x * ahead.x + offset.y * ahead.y;
      const double aside = std::abs(offset.x * ahead.y - offset.y * ahead.x);
      if (aside <= tolerance_ && along > at.along - tolerance_ && along < length + tolerance_)
        steps.push_back({to, along});
    }
    std::ranges::sort(steps, std::greater<>(), &Step::along);
    return steps;
  }

  const PlainMesh& mesh_;
  std::vector<Pair> ways_;
  std::vector<Index> by_place_;
  double tolerance_ = 0;
};

void verify_coverage(const PlainMesh& mesh, const Workload& workload, Verdict& verdict) {
  const Coverage coverage(mesh);
  for (const auto& [points, ends] : workload) {
    const std::size_t n = points.size();
    const std::size_t segments = ends == cdt::closed && n > 1 ? n : n - 1;
    for (std::size_t i = 0; i < segments; ++i)
      if (!coverage.covers(points[i], points[(i + 1) % n])) ++verdict.uncovered_segments;
  }
}

template <std::size_t N>
std::vector<std::array<Point, N>> places(const PlainMesh& mesh,
                                         const std::vector<std::array<Index, N>>& shapes) {
  std::vector<std::array<Point, N>> places;
  places.reserve(shapes.size());
  for (const auto& shape : shapes) {
    std::array<Point, N>& corners = places.emplace_back();
    std::ranges::transform(shape, corners.begin(), [&](Index v) { return mesh.vertices[v]; });
    std::rotate(corners.begin(), std::ranges::min_element(corners), corners.end());
  }
  std::ranges::sort(places);
  return places;
}

std::vector<Point> sorted_vertices(const PlainMesh& mesh) {
  std::vector<Point> points = mesh.vertices;
  std::ranges::sort(points);
  return points;
}

}  // namespace

PlainMesh plain(const Triangulation& mesh) {
  PlainMesh result;
  std::vector<Index> index(mesh.vertex_bound());
  for (Index v = 1; v < mesh.vertex_bound(); ++v) {
    if (!mesh.is_vertex(VertexId(v))) continue;
    index[v] = static_cast<Index>(result.vertices.size());
    result.vertices.push_back(mesh.point(VertexId(v)));
  }
  const auto corner = [&](EdgeId e) { return index[mesh.from(e).index()]; };
  for (Index t = 0; t < mesh.triangle_bound(); ++t) {
    if (!mesh.is_triangle(TriangleId(t))) continue;
    const EdgeId sides[3] = {Triangulation::edge(TriangleId(t), 0),
                             Triangulation::edge(TriangleId(t), 1),
                             Triangulation::edge(TriangleId(t), 2)};
    for (const EdgeId e : sides)
      if (mesh.is_constrained(e) && e < mesh.twin(e))
        result.constrained.push_back({corner(e), corner(mesh.twin(e))});
    if (!mesh.is_infinite(TriangleId(t)))
      result.triangles.push_back({corner(sides[0]), corner(sides[1]), corner(sides[2])});
  }
  return result;
}

void Verdict::print() const {
  std::printf(
      "verify nv=%zu nt=%zu ncedges=%zu bad_orient=%zu non_delaunay=%zu nonmanifold=%zu "
      "constrained_edges_not_in_mesh=%zu uncovered_input_segments=%zu\n",
      vertices, triangles, constrained_edges, bad_orientation, non_delaunay, nonmanifold,
      constrained_missing, uncovered_segments);
}

Verdict verify(const PlainMesh& mesh, const Workload& workload) {
  Verdict verdict;
  verdict.vertices = mesh.vertices.size();
  verdict.triangles = mesh.triangles.size();
  verdict.constrained_edges = mesh.constrained.size();
  verify_triangles(mesh, verdict);
  verify_edges(mesh, verdict);
  verify_coverage(mesh, workload, verdict);
  return verdict;
}

Sameness compare(const PlainMesh& one, const PlainMesh& other) {
  return {sorted_vertices(one) == sorted_vertices(other),
          places(one, one.triangles) == places(other, other.triangles),
          places(one, one.constrained) == places(other, other.constrained)};
}

}  // namespace loft::bench
