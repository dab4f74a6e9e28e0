// SPDX-License-Identifier: MIT
#include "reconstruct/shape/outlines.h"

#include <algorithm>
#include <cmath>

namespace loft {

using cdt::Point;

std::vector<OutlinePoint> outline_points(const Region& region) {
  std::vector<OutlinePoint> found(region.points.size());
  for (std::size_t i = 0; i < region.loop_count(); ++i) {
    const auto loop = region.loop(i);
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const Point before = region.points[loop[(k + loop.size() - 1) % loop.size()]];
      const Point here = region.points[loop[k]];
      const Point after = region.points[loop[(k + 1) % loop.size()]];
      const Point come{here.x - before.x, here.y - before.y};
      const Point go{after.x - here.x, after.y - here.y};
      const double come_length = std::hypot(come.x, come.y);
      const double go_length = std::hypot(go.x, go.y);
      if (come_length == 0 || go_length == 0) continue;  // a lone point
      OutlinePoint& point = found[loop[k]];
      point.facing.x += come.y / come_length + go.y / go_length;
      point.facing.y -= come.x / come_length + go.x / go_length;
      point.turn = std::max(point.turn, std::abs(std::atan2(come.x * go.y - come.y * go.x,
                                                            come.x * go.x + come.y * go.y)));
      const double edge = std::min(come_length, go_length);
      point.edge = point.edge > 0 ? std::min(point.edge, edge) : edge;
    }
  }
  return found;
}

std::vector<OutlinePoint> outline_points(const Region& lower, const Region& upper) {
  std::vector<OutlinePoint> points = outline_points(lower);
  const std::vector<OutlinePoint> above = outline_points(upper);
  points.insert(points.end(), above.begin(), above.end());
  return points;
}

}  // namespace loft
