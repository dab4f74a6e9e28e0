// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "cdt/point.h"
#include "overlay/area.h"

namespace loft::overlay {

/// The corners of a closed outline, the first one not repeated.
using Ring = std::vector<cdt::Point>;

/// What is inside one outline and outside of its holes.
struct Polygon {
  Ring outer;               ///< counter-clockwise where Loft made it
  std::vector<Ring> holes;  ///< clockwise where Loft made them

  friend bool operator==(const Polygon&, const Polygon&) = default;
};

using MultiPolygon = std::vector<Polygon>;

/// Precondition: outer rings are counter-clockwise, holes clockwise.
[[nodiscard]] ExactArea area(const Polygon& polygon);
[[nodiscard]] ExactArea area(const MultiPolygon& polygons);

}  // namespace loft::overlay
