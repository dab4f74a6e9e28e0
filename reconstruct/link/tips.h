// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "reconstruct/link/link_orders.h"
#include "reconstruct/tile/slab.h"
#include "reconstruct/tile/tiles.h"

namespace loft {

/// A part that ends in points and lines of the other slice.
struct Tip {
  Level level;                       ///< the slice of the part
  std::vector<std::uint32_t> loops;  ///< of the part, sorted
  std::vector<std::uint32_t> lines;  ///< of the other slice's region, sorted
  TileSet tiles;                     ///< as tiles of the slab
};

/// The parts that overlap nothing of the other slice and cover some of its lines, in projection and
/// each of these as a whole. A function of the two regions. Cost: nothing where there are no lines.
[[nodiscard]] std::vector<Tip> find_tips(const Region& lower, const Region& upper);

/// Tiles what is left of a slab beside its tips.
using TileRest = std::function<OrderedTiles(const Region& lower, const Region& upper,
                                            std::span<const SlabOrder> orders)>;

/// The tiles of a slab with tips. Orders to link a part that ends in one are refused. None if tips
/// meet anything else (exact), as they never should.
[[nodiscard]] std::optional<OrderedTiles> tile_beside(const Region& lower, const Region& upper,
                                                      std::vector<Tip> tips,
                                                      std::span<const SlabOrder> orders,
                                                      const TileRest& tile_rest);

/// The lines of a region that no part ends in, by the pieces of the slabs below and above it (null:
/// there is none).
[[nodiscard]] std::vector<std::uint32_t> unused_lines(const Region& region, const Pieces* below,
                                                      const Pieces* above);

}  // namespace loft
