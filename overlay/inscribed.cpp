// SPDX-License-Identifier: MIT
#include "overlay/inscribed.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "cdt/regions.h"
#include "cdt/triangulation.h"
#include "overlay/distance.h"

namespace loft::overlay {

namespace {

using cdt::Point;
using Corners = std::array<Point, 3>;

/// The corners of the triangles inside a polygon.
std::vector<Corners> triangles_in(const Polygon& polygon) {
  cdt::Triangulation mesh;
  if (polygon.outer.empty()) return {};
  mesh.insert(polygon.outer, cdt::closed);
  for (const Ring& hole : polygon.holes) mesh.insert(hole, cdt::closed);
  const std::vector<bool> is_inside = cdt::odd_parity(mesh);
  std::vector<Corners> result;
  for (std::uint32_t i = 0; i < mesh.triangle_bound(); ++i) {
    const cdt::TriangleId t(i);
    if (!mesh.is_triangle(t) || mesh.is_infinite(t) || !is_inside[i]) continue;
    const auto e = cdt::Triangulation::edge(t);
    result.push_back({mesh.point(mesh.from(e)), mesh.point(mesh.to(e)), mesh.point(mesh.apex(e))});
  }
  return result;
}

/// The centre of the circle inside a triangle.
Point incentre(const Corners& t) {
  const double a = distance(t[1], t[2]);
  const double b = distance(t[2], t[0]);
  const double c = distance(t[0], t[1]);
  const double sum = a + b + c;
  return {(a * t[0].x + b * t[1].x + c * t[2].x) / sum,
          (a * t[0].y + b * t[1].y + c * t[2].y) / sum};
}

/// The centre of the circle through its corners; of a sliver, anywhere.
Point circumcentre(const Corners& t) {
  const Point u{t[1].x - t[0].x, t[1].y - t[0].y};
  const Point v{t[2].x - t[0].x, t[2].y - t[0].y};
  const double twice = 2 * (u.x * v.y - u.y * v.x);
  const double uu = u.x * u.x + u.y * u.y;
  const double vv = v.x * v.x + v.y * v.y;
  return {t[0].x + (v.y * uu - u.y * vv) / twice, t[0].y + (u.x * vv - v.x * uu) / twice};
}

/// How far places are from a polygon's border, negative outside.
class Depths {
 public:
  explicit Depths(const Polygon& polygon) {
    add(polygon.outer);
    for (const Ring& hole : polygon.holes) add(hole);
  }

  [[nodiscard]] double at(Point p) const {
    double nearest = std::numeric_limits<double>::infinity();
    bool is_inside = false;
    for (const auto& [a, b] : edges_) {
      nearest = std::min(nearest, distance(p, nearest_on_segment(p, a, b)));
      if ((a.y > p.y) != (b.y > p.y) && p.x < (b.x - a.x) * ((p.y - a.y) / (b.y - a.y)) + a.x)
        is_inside = !is_inside;
    }
    return is_inside ? nearest : -nearest;
  }

 private:
  void add(const Ring& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i)
      edges_.emplace_back(ring[i], ring[i + 1 == ring.size() ? 0 : i + 1]);
  }

  std::vector<std::pair<Point, Point>> edges_;
};

/// A place that a large disc may have as its centre, and how large at most: as far as to the
/// nearest corner of the triangle that it comes from.
struct Centre {
  Point place;
  double most;

  Centre(Point at, const Corners& t)
      : place(at), most(std::min({distance(at, t[0]), distance(at, t[1]), distance(at, t[2])})) {}
};

/// Steps from a place to deeper ones, shorter and shorter. The depth there.
double climb(const Depths& depths, Point at, double depth, double precision) {
  constexpr std::array<Point, 8> ways{
      {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};
  for (double step = depth / 2; step > depth * precision / 4;) {
    Point best = at;
    double deepest = depth;
    for (const Point way : ways) {
      const Point there{at.x + step * way.x, at.y + step * way.y};
      const double other = depths.at(there);
      if (other > deepest) {
        deepest = other;
        best = there;
      }
    }
    if (deepest <= depth * (1 + precision / 8)) step /= 2;
    at = best;
    depth = deepest;
  }
  return depth;
}

}  // namespace

double inscribed_diameter(const Polygon& polygon, double precision) {
  std::vector<Centre> centres;
  for (const Corners& t : triangles_in(polygon)) {
    centres.emplace_back(incentre(t), t);
    const Centre other(circumcentre(t), t);
    if (std::isfinite(other.most)) centres.push_back(other);
  }
  std::ranges::sort(centres, [](const Centre& a, const Centre& b) {
    return a.most != b.most ? a.most > b.most : a.place < b.place;
  });
  // The deepest few: where a strip is as wide all along, the best step is far from some of them.
  constexpr std::size_t most_climbs = 12;
  const Depths depths(polygon);
  std::vector<std::pair<double, Point>> deepest;
  for (const Centre& centre : centres) {
    if (deepest.size() == most_climbs && centre.most <= deepest.back().first) break;
    const std::pair here(depths.at(centre.place), centre.place);
    if (!(here.first > 0)) continue;
    deepest.insert(std::ranges::upper_bound(deepest, here, std::greater()), here);
    if (deepest.size() > most_climbs) deepest.pop_back();
  }
  double best = 0;
  for (const auto& [depth, place] : deepest)
    best = std::max(best, climb(depths, place, depth, precision));
  return 2 * best;
}

}  // namespace loft::overlay
