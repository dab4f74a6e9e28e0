// SPDX-License-Identifier: MIT
#pragma once

#include "reconstruct/tile/tiles.h"

namespace loft {

/// Takes crossing vertices out of a slab's tiles: each is pulled into
/// a contour vertex beside it where the tiles stay manifold, meet nothing new, touch the slice
/// planes in no new place, and stay within 0.3 of the slab's height of where the crossing was.
/// In a fixed order, so that the result is a function of the two regions.
/// Cost: in practice constant a crossing, plus O(tiles) if there is one.
void collapse_crossings(const Region& lower, const Region& upper, TileSet& tiles);

}  // namespace loft
