// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "reconstruct/defect.h"
#include "reconstruct/stack.h"
#include "reconstruct/surface.h"

namespace loft {

/// Where a vertex of the surface through a stack's slices is in the world: as the file has it,
/// where it is a contour's and the file says so, or else by the frame.
[[nodiscard]] Vec3 world_place(const Stack& stack, const Vec3& place, const Origin& origin);

/// Moves a surface through a stack's slices to where these are in the world: contour vertices to
/// their Contour::places, the others by the frame. Where the surface would meet itself there, as
/// points are not in one plane, all go by the frame, and a DefectKind::off_plane says so.
/// Precondition: the surface is one of the stack's slices. Cost: O(n), O(n log n) with places.
void place_in_world(const Stack& stack, Surface& surface, std::vector<Defect>& repairs);

}  // namespace loft
