// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>

#include "cdt/point.h"

namespace loft::io {

/// Twice what a closed polygon encloses; negative where it goes clockwise.
[[nodiscard]] inline double doubled_area(std::span<const cdt::Point> points) {
  double sum = 0;
  for (std::size_t i = 2; i < points.size(); ++i)
    sum += (points[i - 1].x - points[0].x) * (points[i].y - points[0].y) -
           (points[i].x - points[0].x) * (points[i - 1].y - points[0].y);
  return sum;
}

}  // namespace loft::io
