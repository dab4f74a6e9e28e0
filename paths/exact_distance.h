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

}  // namespace loft::paths
