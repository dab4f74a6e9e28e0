// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "reconstruct/clean/region.h"
#include "reconstruct/link/pieces.h"
#include "reconstruct/shape/smooth_shape.h"
#include "reconstruct/tile/tiles.h"

namespace loft {

/// Bends the tiles of a slab towards the smooth surface through the slices around it. `lower` and
/// `upper` are the regions that `tiles` lie between, `slices[1]` and `slices[2]` their shapes,
/// `pieces` the tiles' pieces. Where parts that do not overlap were linked, the surface bends
/// around their slanted axis.
///
/// Contour vertices and edges stay as they are. Other edges that are off the smooth surface are
/// split and flipped until it is near: see bend(). `tolerance`: how near, in the unit of the
/// slices; not set or 0: as near as they tell where it is. The tiles stay what tile() promises, by
/// exact test: where bent ones would meet, they are straightened until they do not. A function of
/// the tiles and the four slices, so that an edit of a slice changes four slabs at most. Cost: O(n
/// log n) for n tiles, in practice.
[[nodiscard]] TileSet smooth(const Region& lower, const Region& upper, const Surroundings& slices,
                             const Pieces& pieces, TileSet tiles,
                             std::optional<double> tolerance = {});

}  // namespace loft
