// SPDX-License-Identifier: MIT
#pragma once

#include "reconstruct/tile/tiles.h"

namespace loft {

/// Gives quads that are askew, between an edge of the lower slice and one of the upper, a vertex in
/// the middle of their corners where their two diagonals pass each other by more than `most`. Of
/// two triangles such a quad bulges to one side, with long edges by much of a thin part's volume;
/// of four it is as the hyperbolic paraboloid through its edges, whose volume they have exactly,
/// and the same if turned or mirrored. Cost: O(tiles log tiles).
void ease_twists(const Region& lower, const Region& upper, TileSet& tiles, double most);

}  // namespace loft
