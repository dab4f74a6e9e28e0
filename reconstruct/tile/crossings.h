// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "reconstruct/tile/tiles.h"

namespace loft {

/// Takes crossing vertices out of a slab's tiles: each is pulled into
/// a contour vertex beside it where the tiles stay manifold, meet nothing new, touch the slice
/// planes in no new place, and change no more than the slices do there: in volume by about half of
/// the sheets' area times the slab's height, sideways by less than the sheets' width. In an order
/// that depends neither on that height nor on how the stack is turned, so that the result is a
/// function of the two regions. The pieces that the tiles make depend on each other only where one
/// comes into the `reaches` of another, which are added to the tiles. `is_solid`: false if faces
/// look into the solid, as those of a cavity that is looked at alone. False is given back if the
/// bounds of effort have decided something: then that depends on all there is.
/// Cost: in practice constant a crossing, plus O(tiles) if there is one.
bool collapse_crossings(const Region& lower, const Region& upper, TileSet& tiles, bool is_solid,
                        std::optional<double> drift = {});

}  // namespace loft
