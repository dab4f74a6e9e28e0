// SPDX-License-Identifier: MIT
#include "reconstruct/registration/outline.h"

#include <algorithm>
#include <cmath>

namespace loft {

using cdt::Point;

namespace {

/// The middle of a stretch, at a share of an edge that is `whole` long.
Stretch stretch_on(const Region& region, std::uint32_t from, std::uint32_t to, double whole,
                   double share, double length) {
  const Point p = region.points[from];
  const Point q = region.points[to];
  return {{p.x + share * (q.x - p.x), p.y + share * (q.y - p.y)},
          {(q.y - p.y) / whole, (p.x - q.x) / whole},
          length,
          from,
          to,
          share};
}

}  // namespace

std::vector<Stretch> stretches_by_edges(const Region& region, std::uint32_t loop, double length) {
  constexpr double half = 0.5 + 1e-6;  // what is half a part but for rounding is none
  std::vector<Stretch> made;
  const auto vertices = region.loop(loop);
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const std::uint32_t from = vertices[i];
    const std::uint32_t to = vertices[(i + 1) % vertices.size()];
    const Point p = region.points[from];
    const Point q = region.points[to];
    const double whole = std::hypot(q.x - p.x, q.y - p.y);
    const double count = std::max(1.0, std::ceil(whole / length - half));
    for (double k = 0; k < count; ++k)
      made.push_back(stretch_on(region, from, to, whole, (k + 0.5) / count, whole / count));
  }
  return made;
}

double length(const Region& region, std::uint32_t loop) {
  const auto vertices = region.loop(loop);
  double sum = 0;
  Point p = region.points[vertices.back()];
  for (const std::uint32_t v : vertices) {
    const Point q = region.points[v];
    sum += std::hypot(q.x - p.x, q.y - p.y);
    p = q;
  }
  return sum;
}

double perimeter(const Region& region) {
  double sum = 0;
  for (const Segment& edge : boundary(region))
    sum += std::hypot(edge[1].x - edge[0].x, edge[1].y - edge[0].y);
  return sum;
}

}  // namespace loft
