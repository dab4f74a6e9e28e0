// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "reconstruct/tile/tiles.h"

namespace loft {

/// The tiles of a part that ends in points and lines of the other slice.
struct TipTiles {
  TileSet tiles;                     ///< over the part, and upright where tips are on its outline
  std::vector<std::uint32_t> lines;  ///< that it ends in, in their order
};

/// Of the two regions one is the part, with loops and no lines, the other one its tips: lines and
/// no loops. In projection the tiles stay within the part, whatever its shape: so they meet none of
/// what does not overlap it. None if it covers no line, or if rounding spoils the tiles.
/// `contact`: what is nearer than that meets. Cost: that of the CDT.
[[nodiscard]] std::optional<TipTiles> tile_tip(const Region& lower, const Region& upper,
                                               double contact);

}  // namespace loft
