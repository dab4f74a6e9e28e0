// SPDX-License-Identifier: MIT
#include "reconstruct/registration/quads.h"

#include <algorithm>
#include <tuple>

namespace loft {

namespace {

/// A tile at an edge from a vertex of the lower slice to one of the upper.
struct Wing {
  std::uint32_t lower;
  std::uint32_t upper;
  std::uint32_t apex;
  std::uint32_t tile;
};

}  // namespace

std::vector<Quad> find_quads(const Region& lower, const Region& upper, const TileSet& tiles,
                             const std::function<bool(const Tile&)>& counts) {
  const auto lower_count = static_cast<std::uint32_t>(lower.points.size());
  const auto contour_count = lower_count + static_cast<std::uint32_t>(upper.points.size());
  std::vector<Wing> wings;
  for (std::uint32_t t = 0; t < tiles.tiles.size(); ++t) {
    const auto& nodes = tiles.tiles[t].nodes;
    if (!counts(tiles.tiles[t]) || std::ranges::max(nodes) >= contour_count) continue;
    for (unsigned i = 0; i < 3; ++i) {
      const auto [low, high] = std::minmax(nodes[i], nodes[(i + 1) % 3]);
      if (low < lower_count && high >= lower_count)
        wings.push_back({low, high, nodes[(i + 2) % 3], t});
    }
  }
  std::ranges::sort(wings, {}, [](const Wing& wing) {
    return std::tuple(wing.lower, wing.upper, wing.apex, wing.tile);
  });
  std::vector<Quad> quads;
  for (std::size_t i = 0; i + 1 < wings.size(); ++i) {
    const Wing& a = wings[i];
    const Wing& b = wings[i + 1];
    if (a.lower == b.lower && a.upper == b.upper && a.apex < lower_count && b.apex >= lower_count)
      quads.push_back({a.lower, a.upper, a.apex, b.apex, a.tile, b.tile});
  }
  return quads;
}

}  // namespace loft
