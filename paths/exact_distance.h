// SPDX-License-Identifier: MIT
#pragma once

#include "cdt/point.h"

namespace loft::paths {

using cdt::Point;

/// Whether p and q are at least `distance` from each other, or p from the line through a and b,
/// which are different, or p from the segment ab. Exact; `distance` is not negative.
[[nodiscard]] bool is_as_far(Point p, Point q, double distance);
[[nodiscard]] bool is_as_far_from_line(Point p, Point a, Point b, double distance);
[[nodiscard]] bool is_as_far_from_segment(Point p, Point a, Point b, double distance);

/// Whether the foot of the perpendicular from p to the line ab is strictly between a and b; up to
/// rounding.
[[nodiscard]] inline bool has_foot_between(Point p, Point a, Point b) {
  const double x = b.x - a.x;
  const double y = b.y - a.y;
  return (p.x - a.x) * x + (p.y - a.y) * y > 0 && (b.x - p.x) * x + (b.y - p.y) * y > 0;
}

}  // namespace loft::paths
