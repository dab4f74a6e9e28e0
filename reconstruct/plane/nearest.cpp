// SPDX-License-Identifier: MIT
#include "reconstruct/plane/nearest.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace loft {

namespace {

double squared_distance(cdt::Point p, cdt::Point a, cdt::Point b) {
  const double x = b.x - a.x;
  const double y = b.y - a.y;
  const double length = x * x + y * y;
  const double along = (p.x - a.x) * x + (p.y - a.y) * y;
  const double t = length > 0 ? std::clamp(along / length, 0.0, 1.0) : 0.0;
  const double dx = p.x - (a.x + t * x);
  const double dy = p.y - (a.y + t * y);
  return dx * dx + dy * dy;
}

}  // namespace

cdt::Point foot(cdt::Point p, cdt::Point a, cdt::Point b) {
  const cdt::Point along{b.x - a.x, b.y - a.y};
  const double t = (p.x - a.x) * along.x + (p.y - a.y) * along.y;
  const double length = along.x * along.x + along.y * along.y;
  if (!(t > 0)) return a;
  if (t >= length) return b;
  return {a.x + t / length * along.x, a.y + t / length * along.y};
}

double distance(cdt::Point p, cdt::Point a, cdt::Point b) {
  return std::sqrt(squared_distance(p, a, b));
}

double NearestSegment::distance(cdt::Point p) const {
  double best = std::numeric_limits<double>::infinity();
  tree_.visit_near(p, best, [&](const Segment& segment) {
    return best = std::min(best, squared_distance(p, segment[0], segment[1]));
  });
  return std::sqrt(best);
}

}  // namespace loft
