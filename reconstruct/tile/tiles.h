// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "cdt/triangulation.h"
#include "mesh/mesh.h"
#include "mesh/predicates.h"
#include "reconstruct/clean/region.h"
#include "reconstruct/origin.h"
#include "reconstruct/tile/lift.h"

namespace loft {

/// A triangle of a slab, by nodes.
struct Tile {
  std::array<std::uint32_t, 3> nodes;
  FaceKind kind;
};

/// Where the tiles at a crossing may have been decided by what else is there.
struct Reach {
  cdt::Box box;
  std::uint32_t node;  ///< a contour vertex of the same piece
};

/// All triangles of one slab. Nodes are numbered as in Lift: the points of the lower region, those
/// of the upper region, then the inner vertices. Faces look out of the solid.
struct TileSet {
  std::vector<InnerVertex> inner;
  std::vector<Tile> tiles;
  std::vector<Reach> reaches;
  bool is_plain = false;  ///< they are what the overlay gives, without doubt: see tile_plain()
  bool is_linked = true;  ///< false: no valid tiles between the slices were found, both end here
};

/// Where a node of a slab's tiles is.
[[nodiscard]] inline Vec3 place_of(const Region& lower, const Region& upper,
                                   std::span<const InnerVertex> inner, std::uint32_t node) {
  if (node < lower.points.size()) return {lower.points[node].x, lower.points[node].y, lower.z};
  node -= static_cast<std::uint32_t>(lower.points.size());
  if (node < upper.points.size()) return {upper.points[node].x, upper.points[node].y, upper.z};
  return inner[node - upper.points.size()].place;
}

/// What a tile covers seen from above.
[[nodiscard]] inline cdt::Box footprint(const Corners& corners) {
  cdt::Box box;
  for (const Vec3& p : corners) box.add({p[0], p[1]});
  return box;
}

/// Drops the inner vertices that no tile has; the others are renumbered, in their order.
void drop_unused_inner(std::vector<Tile>& tiles, std::vector<InnerVertex>& inner,
                       std::uint32_t contour_count);

/// How many nodes are contour vertices: those of the lower region, then those of the upper one.
/// Inner vertices come behind them.
[[nodiscard]] inline std::uint32_t contour_count(const Region& lower, const Region& upper) {
  return static_cast<std::uint32_t>(lower.points.size() + upper.points.size());
}

/// The surface between two neighbouring slices: a pure function
/// of the two regions. It touches the slice planes in the contours alone, each contour edge is an
/// edge of exactly one tile, unsplit; so slabs fit together whatever is on the other side.
/// Cost: that of the CDT of both slices.
[[nodiscard]] TileSet tile(const Region& lower, const Region& upper);

/// Memory that tile() uses again from slab to slab. Not for several threads at once.
struct TileWorkspace {
  cdt::Triangulation overlay;
  cdt::Triangulation wall;
};

/// The same tiles, without new memory for their triangulations.
[[nodiscard]] TileSet tile(const Region& lower, const Region& upper, TileWorkspace& workspace);

/// Triangles of an overlay lower than that are tested for what rounding does to them: a function of
/// the slab's size, rounded up to a power of two.
[[nodiscard]] double doubt(const Region& lower, const Region& upper);
/// Contours of the two that come nearer to each other than that are taken to meet: by rounding
/// alone they may, or may not.
[[nodiscard]] double contact(const Region& lower, const Region& upper);

/// The tiles of a part of a slab, as tile() makes them, if nothing about them is in doubt: then
/// they do not depend on what else is in the slab, but for what comes into their `reaches`. `doubt`
/// is that of the whole slab; `is_solid` is false if what the regions enclose is a cavity there.
[[nodiscard]] std::optional<TileSet> tile_plain(const Region& lower, const Region& upper,
                                                double doubt, bool is_solid,
                                                TileWorkspace& workspace);

/// No limit.
inline constexpr std::size_t any_number = std::numeric_limits<std::size_t>::max();

/// The same with the upper region moved by `shift` while vertices are chosen to link: a shear of
/// the slab, taken back afterwards, so that contour vertices are where they were and others move by
/// their height's share of the shift. None if no valid tiles are
/// found, or if that would take tests of more than `most_pairs` pairs of tiles: these are a few for
/// each tile, but their number grows with its square where an edge lies along thousands of others.
[[nodiscard]] std::optional<TileSet> tile_moved(const Region& lower, const Region& upper,
                                                cdt::Point shift,
                                                std::size_t most_pairs = any_number);

/// Whether two tiles meet elsewhere than in common corners and edges (exact); also true if one is
/// flat, or if that would take tests of more than `pairs_left` pairs.
[[nodiscard]] bool tiles_meet(const Region& lower, const Region& upper, const TileSet& tiles,
                              std::size_t& pairs_left);

/// The same tiles for regions that were moved over each other: crossings stay, for the caller to
/// collapse once the tiles are where they belong.
[[nodiscard]] std::optional<TileSet> tile_with_crossings(const Region& lower, const Region& upper,
                                                         std::size_t most_pairs);

/// Nothing is linked: each region ends before half way, whatever is above or below it.
[[nodiscard]] TileSet tile_apart(const Region& lower, const Region& upper);

}  // namespace loft
