// SPDX-License-Identifier: MIT
#include "reconstruct/clean/region.h"

#include <algorithm>

namespace loft {

std::vector<Segment> boundary(const Region& region) {
  std::vector<Segment> edges;
  edges.reserve(region.loop_vertices.size());
  for (std::size_t i = 0; i < region.loop_count(); ++i) {
    const auto loop = region.loop(i);
    for (std::size_t k = 0; k < loop.size(); ++k)
      edges.push_back({region.points[loop[k]], region.points[loop[(k + 1) % loop.size()]]});
  }
  return edges;
}

double area(const Region& region) {
  if (region.is_empty()) return 0;
  const cdt::Point origin = region.points.front();
  double sum = 0;
  for (const Segment& edge : boundary(region))
    sum += (edge[0].x - origin.x) * (edge[1].y - origin.y) -
           (edge[0].y - origin.y) * (edge[1].x - origin.x);
  return sum / 2;
}

bool is_same_in_slice(const Region& a, const Region& b) {
  const auto is_same = [](const Origin& p, const Origin& q) { return is_same_in_slice(p, q); };
  return a.points == b.points && a.loop_vertices == b.loop_vertices &&
         a.loop_starts == b.loop_starts && a.line_vertices == b.line_vertices &&
         a.line_starts == b.line_starts && std::ranges::equal(a.origins, b.origins, is_same) &&
         std::ranges::equal(a.line_origins, b.line_origins, is_same);
}

void insert_loops(const Region& region, cdt::Triangulation& mesh, cdt::Point shift) {
  std::vector<cdt::Point> points;
  for (std::size_t i = 0; i < region.loop_count(); ++i) {
    points.clear();
    for (const std::uint32_t v : region.loop(i))
      points.push_back({region.points[v].x + shift.x, region.points[v].y + shift.y});
    mesh.insert(points, cdt::closed);
  }
}

}  // namespace loft
