// SPDX-License-Identifier: MIT
#pragma once

#include "overlay/polygon.h"

namespace loft::overlay {

/// The diameter of the largest disc inside a polygon, as far as it is found: never too large, and
/// in practice at most `precision` of it too small. The largest discs touch the border in three
/// places, so centres near them are those of circles through the corners of the polygon's Delaunay
/// triangles, where it is wide, and of circles inside these, where it is a sliver; the best few are
/// moved for as long as that helps. Cost: O(n log n) to triangulate, O(n) for each centre that is
/// not ruled out by its own triangle.
[[nodiscard]] double inscribed_diameter(const Polygon& polygon, double precision);

}  // namespace loft::overlay
