// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "reconstruct/surface.h"

namespace loft {

/// Of each vertex, whether it is one of those by which the rims of an open surface are kept within
/// `tolerance`: from the smallest place of each rim on, edges go on as far as they may. Vertices
/// that go one by one, those that move the rim least first, leave half as many again.
///
/// The distance between a rim and what it becomes is measured along both, as curves.
/// Cost: O(n log n).
[[nodiscard]] std::vector<bool> rim_vertices_to_keep(const Surface& surface, double tolerance);

}  // namespace loft
