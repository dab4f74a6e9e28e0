// SPDX-License-Identifier: MIT
#include "reconstruct/link/untangle.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "reconstruct/link/extract.h"
#include "reconstruct/link/links.h"
#include "reconstruct/link/replace.h"

namespace loft {

namespace {

/// Torn pieces that overlap less than that are moved as their outlines match. Where they overlap
/// more, a window is likely to be there.
constexpr double torn_overlap = 0.15;
/// And must leave no more of the difference than that: as slides.
constexpr double most_left = 0.7;

/// The Euler characteristic of each piece, twice. A band from a loop to a loop has 0; one with a
/// window in it, or with a handle, has less. Cost: O(tiles).
std::vector<long> twice_euler(const Region& lower, const Region& upper, const TileSet& tiles,
                              const Pieces& pieces) {
  std::vector<long> sums(pieces.pieces.size());
  std::vector<bool> is_seen(lower.points.size() + upper.points.size() + tiles.inner.size());
  for (std::size_t t = 0; t < tiles.tiles.size(); ++t) {
    long& sum = sums[pieces.of_tile[t]];
    --sum;  // twice a face, less its share of three edges
    for (const std::uint32_t node : tiles.tiles[t].nodes) {
      if (!is_seen[node]) sum += 2;
      is_seen[node] = true;
    }
  }
  const auto take_rims = [&](const Region& region, const Footprint& footprint, long& sum) {
    for (const std::uint32_t loop : footprint.loops)
      sum -= static_cast<long>(region.loop(loop).size());
  };
  for (std::size_t i = 0; i < sums.size(); ++i) {
    take_rims(lower, pieces.pieces[i].lower, sums[i]);
    take_rims(upper, pieces.pieces[i].upper, sums[i]);
  }
  return sums;
}

/// Whether a piece has one outline in both slices, and as many holes.
bool is_alike(const Piece& piece) {
  return piece.lower.parts == 1 && piece.upper.parts == 1 &&
         piece.lower.loops.size() == piece.upper.loops.size();
}

/// Whether these tiles alone, between a piece's outlines, have neither window nor handle.
bool is_band(const Region& lower, const Region& upper, const Piece& piece, const TileSet& tiles) {
  std::vector<std::uint32_t> nodes;
  for (const Tile& tile : tiles.tiles)
    nodes.insert(nodes.end(), tile.nodes.begin(), tile.nodes.end());
  std::ranges::sort(nodes);
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  std::size_t rims = 0;
  for (const std::uint32_t loop : piece.lower.loops) rims += lower.loop(loop).size();
  for (const std::uint32_t loop : piece.upper.loops) rims += upper.loop(loop).size();
  return 2 * nodes.size() == tiles.tiles.size() + rims;
}

/// The tiles of each of some pieces, and of no others.
std::vector<std::vector<std::uint32_t>> tiles_of(std::span<const std::uint32_t> some,
                                                 const Pieces& pieces) {
  std::vector<bool> is_one(pieces.pieces.size());
  for (const std::uint32_t i : some) is_one[i] = true;
  std::vector<std::vector<std::uint32_t>> found(pieces.pieces.size());
  for (std::uint32_t t = 0; t < pieces.of_tile.size(); ++t)
    if (is_one[pieces.of_tile[t]]) found[pieces.of_tile[t]].push_back(t);
  return found;
}

/// Whether no edge of a piece has more than two tiles: it does where the slices touch, and seems to
/// have handles there until it is taken apart.
bool is_plain_surface(const TileSet& tiles, std::span<const std::uint32_t> of_piece) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const std::uint32_t t : of_piece) {
    const auto& nodes = tiles.tiles[t].nodes;
    for (unsigned i = 0; i < 3; ++i) edges.emplace_back(nodes[i], nodes[(i + 1) % 3]);
  }
  std::ranges::sort(edges);
  return std::ranges::adjacent_find(edges) == edges.end();
}

/// What is in one of a piece's footprints only. Measured on tiles that keep their crossings:
/// without them some lie over others, and cover more.
double true_difference(const Region& lower, const Region& upper, const Piece& piece) {
  const Extract below(lower, piece.lower.loops, piece.is_solid);
  const Extract above(upper, piece.upper.loops, piece.is_solid);
  const auto tiles = tile_with_crossings(below.region(), above.region(), any_number);
  if (!tiles) return std::numeric_limits<double>::infinity();
  const Pieces alone{{Piece{}}, std::vector<std::uint32_t>(tiles->tiles.size(), 0)};
  return differences(below.region(), above.region(), *tiles, alone)[0];
}

}  // namespace

void untangle(const Region& lower, const Region& upper, TileSet& tiles, Pieces& pieces,
              std::optional<double> max_shift) {
  const auto is_steiner = [](const InnerVertex& v) { return v.kind == VertexKind::steiner; };
  if (std::ranges::none_of(tiles.inner, is_steiner)) return;
  const std::vector<long> euler = twice_euler(lower, upper, tiles, pieces);
  std::vector<std::uint32_t> torn;
  for (std::uint32_t i = 0; i < pieces.pieces.size(); ++i) {
    const Piece& piece = pieces.pieces[i];
    if (piece.reason == LinkReason::overlap && is_alike(piece) && euler[i] < 0) torn.push_back(i);
  }
  if (torn.empty()) return;
  const std::vector<double> before = differences(lower, upper, tiles, pieces);
  std::erase_if(
      torn, [&](std::uint32_t i) { return overlap(pieces.pieces[i], before[i]) >= torn_overlap; });
  const auto tiles_of_torn = tiles_of(torn, pieces);
  std::vector<Replacement> replacements;
  for (const std::uint32_t i : torn) {
    if (!is_plain_surface(tiles, tiles_of_torn[i])) continue;
    const Piece& piece = pieces.pieces[i];
    if (overlap(piece, true_difference(lower, upper, piece)) >= torn_overlap) continue;
    const auto is_wanted = [&](const Registered& made) {
      const double way = std::hypot(made.motion.shift.x, made.motion.shift.y);
      return made.difference <= most_left * before[i] && way <= max_shift.value_or(way) &&
             is_band(lower, upper, piece, made.tiles);
    };
    auto moved = move_registered(lower, upper, piece, is_wanted);
    if (!moved) continue;
    moved->piece.reason = LinkReason::registered;
    const std::size_t count = moved->tiles.tiles.size();
    replacements.push_back({std::move(moved->tiles),
                            {{std::move(moved->piece)}, std::vector<std::uint32_t>(count, 0)},
                            {i}});
  }
  replace(lower, upper, tiles, pieces, replacements);
}

}  // namespace loft
