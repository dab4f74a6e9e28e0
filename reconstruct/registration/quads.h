// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "reconstruct/tile/tiles.h"

namespace loft {

/// Two tiles with an edge of each slice; their common edge is one diagonal. By nodes.
struct Quad {
  std::uint32_t lower;  ///< ends of the common edge
  std::uint32_t upper;
  std::uint32_t lower_apex;  ///< ends of the other diagonal
  std::uint32_t upper_apex;
  std::uint32_t lower_tile;  ///< with both vertices of the lower slice
  std::uint32_t upper_tile;
};

/// Those of the tiles that count, by their common edges. All corners are contour vertices.
[[nodiscard]] std::vector<Quad> find_quads(
    const Region& lower, const Region& upper, const TileSet& tiles,
    const std::function<bool(const Tile&)>& counts = [](const Tile&) { return true; });

}  // namespace loft
