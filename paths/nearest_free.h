// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "paths/free_space.h"

namespace loft::paths {

// Where to go instead, if a place is inside an obstacle, outside of everything or cut off.
//
// Distances are compared rounded; of several places as near, the coordinates choose. What is found
// is off from the nearest by rounding, and is itself free: where the nearest point of an edge,
// rounded, is on the wrong side of it, the nearest of the places some units in the last place
// around it is taken that is not; where what is free is too narrow for that, one further along the
// edge, at worst its nearer end, or another edge's that is nearer.
//
// Cost: to locate p, then the triangles that are nearer than the answer, times log; outside of the
// hull, the hull, too. Each throws std::logic_error if the space is stale.

/// The nearest point of what is free; p itself if it is free. None if nothing is, and if p is not
/// finite.
[[nodiscard]] std::optional<Point> nearest_free(const FreeSpace& space, Point p);

/// The nearest point of what can be reached from `from`: is_reachable(from, it). None if `from` is
/// not free, and if p is not finite.
[[nodiscard]] std::optional<Point> nearest_reachable(const FreeSpace& space, Point from, Point p);

}  // namespace loft::paths
