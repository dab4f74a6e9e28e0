// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

#include "cdt/point.h"

namespace loft::paths {

/// As std::hypot is not the same everywhere.
[[nodiscard]] inline double distance_between(cdt::Point a, cdt::Point b) {
  const double x = b.x - a.x;
  const double y = b.y - a.y;
  return std::sqrt(x * x + y * y);
}

/// Whether the foot of the perpendicular from p to the line ab is strictly between a and b; up to
/// rounding.
[[nodiscard]] inline bool has_foot_between(cdt::Point p, cdt::Point a, cdt::Point b) {
  const double x = b.x - a.x;
  const double y = b.y - a.y;
  return (p.x - a.x) * x + (p.y - a.y) * y > 0 && (b.x - p.x) * x + (b.y - p.y) * y > 0;
}

/// How far p is from the segment ab.
[[nodiscard]] inline double distance_to_segment(cdt::Point p, cdt::Point a, cdt::Point b) {
  if (!has_foot_between(p, a, b)) return std::min(distance_between(p, a), distance_between(p, b));
  const double twice_area = (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
  return std::abs(twice_area) / distance_between(a, b);
}

}  // namespace loft::paths
