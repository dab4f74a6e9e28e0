// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>

#include "reconstruct/clean/region.h"
#include "reconstruct/tile/tiles.h"

namespace loft {

/// How two regions were moved over each other.
struct Motion {
  cdt::Point shift;  ///< of the upper region, in the mean of its points
  double turn = 0;   ///< of the lower region to be as the upper one, radians, counter-clockwise
};

/// Tiles of two regions that were moved over each other to choose them.
struct Registered {
  TileSet tiles;
  double difference = 0;  ///< the area inside exactly one region, once they were moved
  Motion motion;
};

/// The tiles between two regions with as many outer loops and as many holes, chosen while both are
/// moved half way over each other, each by a displacement of the plane that its loops' matches
/// suggest: what turns, folds or slants is joined with what it becomes, although it does not
/// overlap. Contour vertices are where they always were; others are put back by their height's
/// share.
///
/// `offset` is about where the upper region is, from the lower one. None if no displacement is an
/// embedding, or if the tiles meet (exact). A function of the regions alone, and the same, but for
/// rounding, if they are turned, mirrored or exchanged. Cost: that of the CDT of both and of each,
/// of a sparse linear system, and of the cube of the places that loops are matched at (at most
/// 128); no more than `most_pairs` pairs of tiles are tested.
[[nodiscard]] std::optional<Registered> tile_registered(const Region& lower, const Region& upper,
                                                        cdt::Point offset, std::size_t most_pairs);

}  // namespace loft
