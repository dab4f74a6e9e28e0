// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>

#include "cdt/point.h"

namespace loft::overlay {

[[nodiscard]] inline double distance(cdt::Point a, cdt::Point b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

/// The point of the segment ab nearest to p, rounded.
[[nodiscard]] inline cdt::Point nearest_on_segment(cdt::Point p, cdt::Point a, cdt::Point b) {
  const double x = b.x - a.x;
  const double y = b.y - a.y;
  const double square = x * x + y * y;
  if (square == 0) return a;
  const double t = std::clamp(((p.x - a.x) * x + (p.y - a.y) * y) / square, 0.0, 1.0);
  return t == 1 ? b : cdt::Point{a.x + t * x, a.y + t * y};
}

}  // namespace loft::overlay
