// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

#include "mesh/vec3.h"

namespace loft {

/// The middle of an edge, the same whichever end is named first.
[[nodiscard]] inline Vec3 edge_middle(const Vec3& a, const Vec3& b) {
  const Vec3& first = std::min(a, b);
  return along(first, 0.5, minus(std::max(a, b), first));
}

/// A way, cut off where it is longer than `most`.
[[nodiscard]] inline Vec3 cut_off(const Vec3& way, double most) {
  const double distance = length(way);
  return distance > most ? along({}, most / distance, way) : way;
}

}  // namespace loft
