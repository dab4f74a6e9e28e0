// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "reconstruct/link/pieces.h"

namespace loft {

/// Tiles to put in the place of whole pieces.
struct Replacement {
  TileSet tiles;
  Pieces pieces;                        ///< what they make
  std::vector<std::uint32_t> replaced;  ///< the pieces that go
};

/// Puts replacements into the place of pieces, best first, as far as they meet nothing else: exact
/// tests against all tiles that stay and all replacements before it. Returns whether any was.
/// Cost: O(tiles + replacements), O(log n) each.
bool replace(const Region& lower, const Region& upper, TileSet& tiles, Pieces& pieces,
             std::span<Replacement> replacements);

/// Several as one that replaces nothing yet. None if some meet.
[[nodiscard]] std::optional<Replacement> together(const Region& lower, const Region& upper,
                                                  std::span<Replacement> each);

/// Adds tiles behind others; inner vertices are renumbered.
void append(TileSet& tiles, const TileSet& more, std::uint32_t contour_count);

}  // namespace loft
