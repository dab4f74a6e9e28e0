// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "paths/free_space.h"

namespace loft::paths {

/// The distance from a point to the nearest thing that blocks the way; 0 if the point is not free.
/// Rounded. Cost: to locate it, then the triangles nearer than the answer. Precondition: the space
/// keeps gaps; std::logic_error otherwise.
[[nodiscard]] double clearance(const FreeSpace& space, Point p);

/// Whether a disc can stand at a point: nothing that blocks the way is nearer than its radius.
/// Exact. Precondition: as above.
[[nodiscard]] bool is_clear(const FreeSpace& space, Point p, double radius);
/// The same in memory that is there already.
[[nodiscard]] bool is_clear(const FreeSpace& space, Point p, double radius,
                            std::vector<TriangleId>& scratch);

/// The radius of the largest disc that gets from one point to another: one of this radius does, and
/// none whose radius is the next double; 0 if only a point does, negative if nothing does.
/// Precondition: as above. Cost: the triangles, times log.
[[nodiscard]] double widest(const FreeSpace& space, Point from, Point to);

/// The triangle of the gaps' mesh that a point is in, or one that it is on the border of: free if
/// any is; none otherwise.
[[nodiscard]] TriangleId triangle_in_gaps(const Gaps& gaps, Point p);

/// The gaps of a space that keeps them and has followed the last edit; std::logic_error otherwise.
[[nodiscard]] const Gaps& gaps_of(const FreeSpace& space);

}  // namespace loft::paths
