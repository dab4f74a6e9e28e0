// SPDX-License-Identifier: MIT
#pragma once

#include "reconstruct/tile/tiles.h"

namespace loft {

/// Takes crossing vertices out of a slab's tiles: each is pulled into
/// a contour vertex beside it where the tiles stay manifold, meet nothing new, touch the slice
/// planes in no new place, and change no more than the slices do there: in volume by about half of
/// the sheets' area times the slab's height, sideways by less than the sheets' width. In an order
/// that depends neither on that height nor on how the stack is turned, so that the result is a
/// function of the two regions.
/// Cost: in practice constant a crossing, plus O(tiles) if there is one.
void collapse_crossings(const Region& lower, const Region& upper, TileSet& tiles);

}  // namespace loft
