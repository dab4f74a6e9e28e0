// SPDX-License-Identifier: MIT
#include "mesh/triangle_shape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "mesh/vec3.h"

namespace loft {

namespace {

/// Side lengths, squared, in order; and twice the area.
struct SideLengths {
  std::array<double, 3> squared;
  double area;
};

/// From corners in a fixed order.
SideLengths side_lengths(Corners t) {
  std::ranges::sort(t);
  SideLengths result{{squared_length(minus(t[1], t[0])), squared_length(minus(t[2], t[1])),
                      squared_length(minus(t[0], t[2]))},
                     length(cross(minus(t[1], t[0]), minus(t[2], t[0])))};
  std::ranges::sort(result.squared);
  return result;
}

}  // namespace

double smallest_sine(const Corners& triangle) {
  const auto [squared, area] = side_lengths(triangle);
  return area > 0 ? area / std::sqrt(squared[1] * squared[2]) : 0;  // between the longer sides
}

double aspect(const Corners& triangle) {
  const auto [squared, area] = side_lengths(triangle);
  if (area == 0) return std::numeric_limits<double>::infinity();
  return squared[2] / area * std::sqrt(0.75);
}

}  // namespace loft
