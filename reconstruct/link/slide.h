// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "reconstruct/link/pieces.h"

namespace loft {

/// Moves the upper contours of pieces over their lower ones by the offset of their centroids, where
/// a piece is one part in each slice, both cover less than 0.6 of what they cover together, and the
/// move takes away at least 0.3 of their difference. Such a piece would be pinched by overlay
/// alone. Before that, pieces of several parts that hardly overlap crosswise are taken apart
/// (separate()), and pieces that overlay has torn, although they have as many outlines and holes
/// in both slices, are moved as these match (move_by_loops()), if that leaves no windows and
/// handles. After it, whatever still overlaps by less than 0.8, with any outlines, as at forks,
/// is moved as their places match (move_by_places()), if that takes away enough of the difference,
/// the more, the more overlaps, and brings the volume nearer to that of a frustum, or if they
/// overlap by less than 0.4, are as large, and no more than a tenth of the difference is left. A
/// function of the two slices.
void slide(const Region& lower, const Region& upper, TileSet& tiles, Pieces& pieces,
           std::optional<double> max_shift);

}  // namespace loft
