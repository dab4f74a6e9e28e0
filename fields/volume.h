// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "fields/field.h"
#include "overlay/polygon.h"

namespace loft::fields {

/// What is between two surfaces, or between a surface and a level: where there are both.
struct Volume {
  double above = 0;       ///< where the first is higher
  double below = 0;       ///< where it is lower
  double area_above = 0;  ///< in the plane
  double area_below = 0;  ///< with what is as high

  [[nodiscard]] double area() const { return area_above + area_below; }
};

/// Of the linear surface over a level. Law: the integral of the values is
/// level * area() + above - below. Cost: O(triangles log triangles).
[[nodiscard]] Volume volume(const Field& field, double level);
/// Within polygons only. Cost: a triangulation of the field's edges and the polygons'.
[[nodiscard]] Volume volume(const Field& field, double level, const overlay::MultiPolygon& within);

/// Between two linear surfaces, as before and after an excavation. Cost: a triangulation of the
/// edges of both.
[[nodiscard]] Volume volume_between(const Field& upper, const Field& lower);
[[nodiscard]] Volume volume_between(const Field& upper, const Field& lower,
                                    const overlay::MultiPolygon& within);

/// The area in the plane where the linear surface rises by less than the first bound, by that or
/// more but less than the next, and so on, to the last or more, in height by length: one more than
/// there are bounds. Precondition: the bounds rise.
[[nodiscard]] std::vector<double> areas_by_slope(const Field& field,
                                                 std::span<const double> bounds);

}  // namespace loft::fields
