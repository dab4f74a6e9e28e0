// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

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

/// Of tiles that are not put back yet: there are more crossings then, but the same Euler
/// characteristic.
using IsWanted = std::function<bool(const Registered&)>;

/// The tiles between two regions with as many outer loops and as many holes, chosen while both are
/// moved half way over each other, each by a displacement of the plane that its loops' matches
/// suggest: what turns, folds or slants is joined with what it becomes, although it does not
/// overlap. Contour vertices are where they always were; others are put back by their height's
/// share.
///
/// `offsets` are about where the upper region may be, from the lower one; from whichever leaves
/// least of a difference, the first of equal ones. None if no displacement is an embedding, if the
/// tiles meet (exact), or if they are not wanted: these are not tested, which takes most of the
/// time. A function of the regions alone, and the same, but for rounding, if they are turned,
/// mirrored or exchanged. Cost: that of the CDT of both and of each, of a sparse linear system, and
/// at most of the cube of the places that loops are matched at (at most 128); no more than
/// `most_pairs` pairs of tiles are tested.
[[nodiscard]] std::optional<Registered> tile_registered(
    const Region& lower, const Region& upper, std::span<const cdt::Point> offsets,
    std::size_t most_pairs, const IsWanted& is_wanted = [](const Registered&) { return true; });

/// The same for regions with any loops, as where a part forks: each stretch of a loop is matched
/// with that of the other region which is nearest to it by place and direction, so that loops go
/// their own ways. What moves by more than it is wide is matched wrongly, unless `ways` tell about
/// how far the loops of each region are to be moved towards the other one: none, or one for each.
struct LoopWays {
  std::vector<cdt::Point> lower;
  std::vector<cdt::Point> upper;
};
[[nodiscard]] std::optional<Registered> tile_registered_by_places(const Region& lower,
                                                                  const Region& upper,
                                                                  std::size_t most_pairs,
                                                                  const IsWanted& is_wanted,
                                                                  const LoopWays& ways = {});

/// The same where loops with ways (not 0) are moved by these, over what the others become, which
/// are matched as if they were alone.
[[nodiscard]] std::optional<Registered> tile_registered_by_ways(const Region& lower,
                                                                const Region& upper,
                                                                std::size_t most_pairs,
                                                                const IsWanted& is_wanted,
                                                                const LoopWays& ways);

}  // namespace loft
