// SPDX-License-Identifier: MIT
#include "reconstruct/plane/signed_distance.h"

#include <cmath>
#include <limits>

namespace loft {

namespace {

using cdt::Point;

/// The foot of p on the segment ab; exactly a or b where it is an end.
Point foot(Point p, Point a, Point b) {
  const Point along{b.x - a.x, b.y - a.y};
  const double t = (p.x - a.x) * along.x + (p.y - a.y) * along.y;
  const double length = along.x * along.x + along.y * along.y;
  if (!(t > 0)) return a;
  if (t >= length) return b;
  return {a.x + t / length * along.x, a.y + t / length * along.y};
}

}  // namespace

/// Where a corner is nearest, the edge that is the next one around it decides on which side of the
/// boundary p is: the one that deviates least from the direction to p.
SignedDistance::Value SignedDistance::at(Point p) const {
  double best = std::numeric_limits<double>::infinity();
  double straightness = -1;  // of the direction to p across the best edge, squared
  Segment nearest{};
  tree_.visit_near(p, best, [&](const Segment& edge) {
    const auto& [from, to] = edge;
    const Point q = foot(p, from, to);
    const double squared = (p.x - q.x) * (p.x - q.x) + (p.y - q.y) * (p.y - q.y);
    if (squared > best) return best;
    const Point along{to.x - from.x, to.y - from.y};
    const double across = along.x * (p.y - q.y) - along.y * (p.x - q.x);
    const double straight = across * across / (along.x * along.x + along.y * along.y);
    if (squared == best && straight <= straightness) return best;
    straightness = straight;
    nearest = edge;
    return best = squared;
  });
  const auto& [from, to] = nearest;
  const Point q = foot(p, from, to);
  const Point along{to.x - from.x, to.y - from.y};
  const double across = along.x * (p.y - q.y) - along.y * (p.x - q.x);
  const double distance = std::sqrt(best);
  if (!(distance > 0)) {
    const double length = std::hypot(along.x, along.y);
    return {0, {along.y / length, -along.x / length}};
  }
  const double sign = across > 0 ? -1 : 1;
  return {sign * distance, {sign * (p.x - q.x) / distance, sign * (p.y - q.y) / distance}};
}

}  // namespace loft
