// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "reconstruct/clean/region.h"
#include "reconstruct/link/pieces.h"
#include "reconstruct/options.h"
#include "reconstruct/tile/tiles.h"

namespace loft {

/// For each loop of a region the loop of another one that is the same, with the same contour, or
/// Origin::none. Cost: O(n log n).
[[nodiscard]] std::vector<std::uint32_t> match_loops(const Region& region, const Region& other);

/// A slab of which one slice was replaced by another one that has some of its loops.
struct SlabChange {
  const Region& old_lower;
  const Region& old_upper;
  const TileSet& old_tiles;
  const Pieces& old_pieces;
  const Region& lower;
  const Region& upper;
  Level changed;  ///< which of the two slices is another one
  /// For each loop of the new slice the same one of the old slice, or Origin::none.
  std::span<const std::uint32_t> old_loops;
};

/// The tiles of the new slab: those of pieces that the change does not touch, then the others.
struct Retiled {
  TileSet tiles;
  Pieces pieces;
  std::vector<std::uint32_t> kept;  ///< the old tiles that are the first new ones
  std::vector<std::uint32_t> gone;  ///< the other old tiles
};

/// Tiles anew only the pieces that have tiles in the box around all loops that came or went:
/// outside of it nothing has changed, and pieces do not depend on one another. Those that lean are
/// tiled anew with them, to be upright again. Law: the tiles are
/// those of tile_by_orders() without orders, in another order. None where that cannot be told from
/// the pieces alone: where contours touch, tiles had to be tested or moved, or the pieces concerned
/// are solids and cavities. Cost: that of the pieces, and O(n) simple steps for what stays.
[[nodiscard]] std::optional<Retiled> retile(const SlabChange& change, const Options& options,
                                            TileWorkspace& workspace);

}  // namespace loft
