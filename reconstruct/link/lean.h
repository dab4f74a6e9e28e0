// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "reconstruct/link/ends.h"

namespace loft {

/// Leans ends, so that their tips lie on the axis that the slices before suggest: a shear that
/// leaves their outlines and all heights as they are. Where a leaning end meets itself or anything
/// else (exact test) it leans half as much, then a quarter, else it stays upright; where two that
/// lean meet, both do. So no order decides. What is linked by now is left out. Cost: O(tiles) to
/// find what is near, the rest by what is near the ends.
void lean_ends(const Region& lower, const Region& upper, TileSet& tiles, Pieces& pieces,
               std::span<const EndLean> leans);

}  // namespace loft
