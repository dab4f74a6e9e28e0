// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "cdt/point.h"

namespace loft::paths {

/// As std::hypot is not the same everywhere.
[[nodiscard]] inline double distance_between(cdt::Point a, cdt::Point b) {
  const double x = b.x - a.x;
  const double y = b.y - a.y;
  return std::sqrt(x * x + y * y);
}

}  // namespace loft::paths
