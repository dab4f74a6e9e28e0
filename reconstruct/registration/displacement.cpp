// SPDX-License-Identifier: MIT
#include "reconstruct/registration/displacement.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <utility>

#include "cdt/predicates.h"
#include "cdt/queries.h"
#include "cdt/regions.h"

namespace loft {

namespace {

using cdt::EdgeId;
using cdt::Point;
using cdt::TriangleId;
using cdt::Triangulation;

/// A triangle of a region's CDT, by the region's points.
using Corner = std::array<std::uint32_t, 3>;

/// The indices of a region's points by vertices of a triangulation of its loops.
std::vector<std::uint32_t> points_of_vertices(const Region& region, const Triangulation& mesh) {
  std::vector<std::uint32_t> point(mesh.vertex_bound(), Origin::none);
  for (std::uint32_t i = 0; i < region.loop_vertices.size(); ++i)
    point[mesh.segment(cdt::SegmentId(i)).from.index()] = region.loop_vertices[i];
  return point;
}

std::vector<Corner> triangles(const Region& region) {
  Triangulation mesh;
  mesh.reserve(region.points.size());
  insert_loops(region, mesh);
  const std::vector<std::uint32_t> point = points_of_vertices(region, mesh);
  std::vector<Corner> found;
  for (std::uint32_t t = 0; t < mesh.triangle_bound(); ++t) {
    if (!mesh.is_triangle(TriangleId(t)) || mesh.is_infinite(TriangleId(t))) continue;
    const EdgeId e = Triangulation::edge(TriangleId(t));
    found.push_back(
        {point[mesh.from(e).index()], point[mesh.to(e).index()], point[mesh.apex(e).index()]});
  }
  return found;
}

double doubled_area(Point a, Point b, Point c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

using Entry = Eigen::Triplet<double>;

/// Triangles that are lower than that share of an edge count as being so high; those that are much
/// lower, as along a straight border, are there by rounding, and do not count.
constexpr double least_slope = 1e-6;
constexpr double slope_by_rounding = 1e-9;

/// How much two points that a side of triangles joins have in common: the sum of the cotangents of
/// the angles that it is seen at. It is 0 for the diagonal of places on one circle, and the others
/// are the same then whichever diagonal is there.
struct Spring {
  std::uint32_t from;  // less than to
  std::uint32_t to;
  double weight;
};

double longest_squared(const std::array<Point, 3>& at) {
  double longest = 0;
  for (unsigned k = 0; k < 3; ++k) {
    const double x = at[(k + 1) % 3].x - at[k].x;
    const double y = at[(k + 1) % 3].y - at[k].y;
    longest = std::max(longest, x * x + y * y);
  }
  return longest;
}

std::vector<Spring> springs(const Region& region, std::span<const Corner> triangles) {
  std::vector<Spring> all;
  for (const Corner& t : triangles) {
    const std::array<Point, 3> at{region.points[t[0]], region.points[t[1]], region.points[t[2]]};
    const double area = doubled_area(at[0], at[1], at[2]);
    if (area <= slope_by_rounding * longest_squared(at)) continue;
    for (unsigned k = 0; k < 3; ++k) {
      const Point p = at[k];
      const Point q = at[(k + 1) % 3];
      const Point r = at[(k + 2) % 3];
      const double squared = (q.x - p.x) * (q.x - p.x) + (q.y - p.y) * (q.y - p.y);
      const double inner = (p.x - r.x) * (q.x - r.x) + (p.y - r.y) * (q.y - r.y);
      const auto [from, to] = std::minmax(t[k], t[(k + 1) % 3]);
      all.push_back({from, to, inner / std::max(2 * area, least_slope * squared)});
    }
  }
  const auto ends = [](const Spring& spring) { return std::pair(spring.from, spring.to); };
  std::ranges::stable_sort(all, {}, ends);
  std::vector<Spring> whole;
  for (const Spring& spring : all) {
    if (!whole.empty() && ends(whole.back()) == ends(spring)) {
      whole.back().weight += spring.weight;
    } else {
      whole.push_back(spring);
    }
  }
  return whole;
}

/// The normal equations of the pulls and of the smoothness, solved.
std::optional<std::vector<Point>> solve(std::size_t point_count, std::span<const Spring> springs,
                                        std::span<const Pull> pulls, double softness) {
  const auto count = static_cast<Eigen::Index>(point_count);
  std::vector<Entry> entries;
  Eigen::MatrixX2d right = Eigen::MatrixX2d::Zero(count, 2);
  const auto add = [&](std::uint32_t i, std::uint32_t j, double value) {
    entries.emplace_back(static_cast<int>(i), static_cast<int>(j), value);
  };
  for (const Pull& pull : pulls) {
    const double weight = pull.weight / softness;
    const std::array ends{std::pair(pull.stretch.from, 1 - pull.stretch.share),
                          std::pair(pull.stretch.to, pull.stretch.share)};
    for (const auto& [i, share] : ends) {
      right(i, 0) += weight * share * pull.way.x;
      right(i, 1) += weight * share * pull.way.y;
      for (const auto& [j, other] : ends) add(i, j, weight * share * other);
    }
  }
  for (const auto& [i, j, weight] : springs) {
    add(i, i, weight);
    add(j, j, weight);
    add(i, j, -weight);
    add(j, i, -weight);
  }
  Eigen::SparseMatrix<double> matrix(count, count);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors(matrix);
  if (factors.info() != Eigen::Success) return {};
  const Eigen::MatrixX2d solution = factors.solve(right);
  std::vector<Point> ways;
  for (Eigen::Index i = 0; i < count; ++i) {
    ways.push_back({solution(i, 0), solution(i, 1)});
    if (!std::isfinite(ways.back().x) || !std::isfinite(ways.back().y)) return {};
  }
  return ways;
}

bool are_usable(const Region& region, std::span<const Point> ways) {
  return std::ranges::all_of(moved(region, ways).points, [](Point p) {
    return Triangulation::is_usable(p.x) && Triangulation::is_usable(p.y);
  });
}

/// Shortens ways where loops would cross or turn over.
class Settling {
 public:
  Settling(const Region& region, std::span<const Spring> springs, std::vector<Point>& ways)
      : region_(region), springs_(springs), ways_(ways) {}

  /// Whether none does in the end.
  bool run() {
    constexpr int rounds = 30;
    constexpr int smooth_rounds = 12;
    for (int round = 0; round < rounds; ++round) {
      if (!find_turned()) return true;
      if (round < smooth_rounds) {
        smooth();
      } else {
        shorten();
      }
    }
    return !find_turned();
  }

 private:
  /// Finds the ends of moved edges that cross or touch others, or that have the region on the wrong
  /// side; and points that have become one with others.
  bool find_turned() {
    is_turned_.assign(ways_.size(), false);
    Triangulation mesh;
    const Region moved = loft::moved(region_, ways_);
    mesh.reserve(moved.points.size());
    insert_loops(moved, mesh);
    const std::vector<std::uint32_t> point = points_of_vertices(moved, mesh);
    const std::vector<bool> is_inside = cdt::odd_parity(mesh);
    std::vector<bool> is_alone(ways_.size());
    for (const std::uint32_t i : point)
      if (i != Origin::none) is_alone[i] = true;
    for (std::uint32_t i = 0; i < mesh.edge_bound(); ++i) {
      const EdgeId e(i);
      for (const cdt::Passage passage : mesh.passages(e)) {
        const cdt::Segment& segment = mesh.segment(passage.segment());
        const bool is_boundary = is_inside[Triangulation::triangle(e).index()] &&
                                 !is_inside[Triangulation::triangle(mesh.twin(e)).index()];
        const bool is_whole = segment.from == mesh.from(e) && segment.to == mesh.to(e);
        if (!mesh.is_forward(e, passage) || (is_boundary && is_whole)) continue;
        for (const cdt::VertexId v : {segment.from, segment.to})
          is_turned_[point[v.index()]] = true;
      }
    }
    for (std::size_t i = 0; i < ways_.size(); ++i)
      if (!is_alone[i]) is_turned_[i] = true;
    return std::ranges::find(is_turned_, true) != is_turned_.end();
  }

  /// Half way to the mean of all around, as far as they have much in common.
  void smooth() {
    std::vector<Point> sums(ways_.size());
    std::vector<double> weights(ways_.size());
    const auto add = [&](std::uint32_t i, std::uint32_t j, double weight) {
      sums[i] = {sums[i].x + weight * ways_[j].x, sums[i].y + weight * ways_[j].y};
      weights[i] += weight;
    };
    for (const auto& [i, j, weight] : springs_) {
      if (weight < least_weight) continue;
      add(i, j, weight);
      add(j, i, weight);
    }
    for (std::size_t i = 0; i < ways_.size(); ++i)
      if (is_turned_[i] && weights[i] > 0)
        ways_[i] = {(ways_[i].x + sums[i].x / weights[i]) / 2,
                    (ways_[i].y + sums[i].y / weights[i]) / 2};
  }

  /// Where something is wrong, and around there.
  void shorten() {
    std::vector<bool> is_near = is_turned_;
    for (const auto& [i, j, weight] : springs_)
      if (weight >= least_weight && (is_turned_[i] || is_turned_[j]))
        is_near[i] = is_near[j] = true;
    for (std::size_t i = 0; i < ways_.size(); ++i)
      if (is_near[i]) ways_[i] = {ways_[i].x / 2, ways_[i].y / 2};
  }

  /// Less is none, but for rounding.
  static constexpr double least_weight = 1e-6;

  const Region& region_;
  std::span<const Spring> springs_;
  std::vector<Point>& ways_;
  std::vector<bool> is_turned_;  // points where something is wrong
};

}  // namespace

Region moved(const Region& region, std::span<const Point> ways) {
  const auto add = [](double x, double way) {
    const double sum = x + way;
    return std::abs(sum) < Triangulation::smallest_coordinate ? 0 : sum;
  };
  Region made = region;
  for (std::size_t i = 0; i < ways.size(); ++i)
    made.points[i] = {add(region.points[i].x, ways[i].x), add(region.points[i].y, ways[i].y)};
  return made;
}

std::optional<Displacement> Displacement::fit(const Region& region, std::span<const Pull> pulls,
                                              double softness) {
  const std::vector<Spring> springs = loft::springs(region, triangles(region));
  const Affine affine = fit_affine(pulls);
  std::vector<Pull> rest(pulls.begin(), pulls.end());
  for (Pull& pull : rest) {
    const Point way = affine.way(pull.stretch.middle);
    pull.way = {pull.way.x - way.x, pull.way.y - way.y};
  }
  auto ways = solve(region.points.size(), springs, rest, softness);
  if (ways)
    for (std::size_t i = 0; i < ways->size(); ++i) {
      const Point way = affine.way(region.points[i]);
      (*ways)[i] = {(*ways)[i].x + way.x, (*ways)[i].y + way.y};
    }
  if (!ways || !are_usable(region, *ways) || !Settling(region, springs, *ways).run()) return {};
  Displacement made;
  made.ways_ = std::move(*ways);
  return made;
}

Interpolation::Interpolation(const Region& region, std::span<const Point> values) {
  mesh_.reserve(region.points.size());
  insert_loops(region, mesh_);
  values_.resize(mesh_.vertex_bound());
  const std::vector<std::uint32_t> point = points_of_vertices(region, mesh_);
  for (std::size_t v = 1; v < values_.size(); ++v)
    if (point[v] != Origin::none) values_[v] = values[point[v]];
}

Point Interpolation::at(Point place) const {
  const cdt::Location found = mesh_.locate(place);
  switch (found.kind) {
    case cdt::Location::Kind::vertex:
      return values_[mesh_.from(found.edge).index()];
    case cdt::Location::Kind::edge:
      return along(found.edge, std::clamp(share(found.edge, place), 0.0, 1.0));
    case cdt::Location::Kind::triangle:
      return inside(found.edge, place);
    case cdt::Location::Kind::outside:
      return beyond(found.edge, place);
    case cdt::Location::Kind::nowhere:
      break;
  }
  return {};
}

/// How far along an edge a place is beside it.
double Interpolation::share(EdgeId e, Point place) const {
  const Point a = mesh_.point(mesh_.from(e));
  const Point b = mesh_.point(mesh_.to(e));
  const Point way{b.x - a.x, b.y - a.y};
  return ((place.x - a.x) * way.x + (place.y - a.y) * way.y) / (way.x * way.x + way.y * way.y);
}

Point Interpolation::along(EdgeId e, double share) const {
  const Point a = values_[mesh_.from(e).index()];
  const Point b = values_[mesh_.to(e).index()];
  return {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y)};
}

Point Interpolation::inside(EdgeId e, Point place) const {
  const std::array corners{mesh_.from(e), mesh_.to(e), mesh_.apex(e)};
  const Point p = mesh_.point(corners[0]);
  const Point q = mesh_.point(corners[1]);
  const Point r = mesh_.point(corners[2]);
  const double whole = doubled_area(p, q, r);
  const std::array shares{doubled_area(place, q, r) / whole, doubled_area(p, place, r) / whole,
                          doubled_area(p, q, place) / whole};
  Point sum;
  for (unsigned i = 0; i < 3; ++i) {
    const Point value = values_[corners[i].index()];
    sum = {sum.x + shares[i] * value.x, sum.y + shares[i] * value.y};
  }
  return sum;
}

/// At the nearest place of the convex hull, which is found by going round it from an edge that the
/// place can be seen from. So a place on the hull may be put outside by rounding.
Point Interpolation::beyond(EdgeId e, Point place) const {
  const auto is_hull = [&](EdgeId edge) {
    return mesh_.from(edge) != Triangulation::infinite && mesh_.to(edge) != Triangulation::infinite;
  };
  for (int i = 0; i < 2 && !is_hull(e); ++i) e = Triangulation::next(e);
  if (!is_hull(e)) return values_[cdt::nearest_vertex(mesh_, place).index()];
  for (std::size_t steps = 0; steps < mesh_.vertex_count(); ++steps) {
    const double here = share(e, place);
    if (here >= 0 && here <= 1) return along(e, here);
    const bool is_ahead = here > 1;
    const EdgeId beside = is_ahead ? Triangulation::next(mesh_.twin(Triangulation::next(e)))
                                   : Triangulation::prev(mesh_.twin(Triangulation::prev(e)));
    const double there = share(beside, place);
    if (is_ahead ? there <= 0 : there >= 1) return along(e, is_ahead ? 1 : 0);
    e = beside;
  }
  return values_[cdt::nearest_vertex(mesh_, place).index()];
}

}  // namespace loft
