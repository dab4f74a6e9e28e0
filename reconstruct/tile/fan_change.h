// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "mesh/predicates.h"

namespace loft {

/// What changes where a fan of triangles takes the place of others around a crossing, in units that
/// do not depend on how far the slices are from each other: areas and lengths in projection.
/// All functions give the same, but for rounding, if everything is turned about an upright axis, or
/// if all heights are stretched; and the very same (gains with the other sign), whichever way
/// round triangles go.

/// How much the slices themselves change around a crossing.
struct SheetsAround {
  double area = 0;   ///< of the sheets there
  double width = 0;  ///< the most by which one of their triangles rises over its longest side

  /// Adds a sheet triangle.
  void add(const Corners& triangle);
};

/// How far a point is from the farthest corner of triangles.
[[nodiscard]] double reach(const Vec3& point, std::span<const Corners> triangles);

/// The volume that is gained where a fan takes the place of the triangles from a crossing to the
/// fan's rim, over the slab's height. The fan has its hub first in each triangle.
[[nodiscard]] double gained_area(const Vec3& crossing, std::span<const Corners> fan, double height);

/// How far the fan is from a crossing at the crossing's height; infinite if it is nowhere there.
[[nodiscard]] double sideways_drift(const Vec3& crossing, std::span<const Corners> fan);

/// Of the worst triangle, once all heights are multiplied by `stretch`. Squared area over the
/// square of the sum of the squared sides: largest for equal sides, 0 if degenerate.
[[nodiscard]] double worst_shape(std::span<const Corners> fan, double stretch);

}  // namespace loft
