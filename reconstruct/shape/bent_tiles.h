// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "reconstruct/shape/freedom.h"
#include "reconstruct/shape/outlines.h"
#include "reconstruct/tile/tiles.h"

namespace loft {

/// How an inner vertex came to its place: from the middle of an edge, or from where it was.
struct VertexMove {
  std::array<std::uint32_t, 2> edge;  ///< none: it was there before
  Vec3 start;
  Vec3 way;
  Vec3 straight;  ///< where it would be if no edge were bent
  double share = 1;
};

/// Tiles bent to the smooth surface, and how to take that back.
struct BentTiles {
  TileSet tiles;
  std::vector<VertexMove> moves;  ///< of each inner vertex
};

/// What is bent: each edge as far as it is off; or what the plain tiles have between the slices.
enum class Bends : std::uint8_t { everywhere, at_forks };

/// How near the tiles come to the smooth surface.
struct Fineness {
  double tolerance;  ///< edges whose middle is further off are split
  int levels;        ///< at most that many times over
  double nearness;   ///< places are found as near as that, as a share of the slab's height
  Bends bends = Bends::everywhere;
};

/// That of a slab of some height: `tolerance`, but no finer than a 2000th of the height; not set or
/// 0: what its slices are worth.
[[nodiscard]] Fineness fineness(double height, std::optional<double> tolerance);
/// That of tiles which are straight but at their forks.
[[nodiscard]] Fineness fork_fineness(double height);

/// Bends tiles, wherever others are.
///
/// The edge that is furthest off the smooth surface comes first. It is split at a point on it, and
/// edges around are flipped where the other diagonal is nearer to it, so that a vertex serves the
/// tiles at several edges (greedy insertion: Garland and Heckbert, 1995; diagonals by what they
/// approximate: Dyn, Levin and Rippa, 1990). At last each vertex goes beyond the surface by what
/// the edges at it stay short of it, so that the tiles are as much beyond as short.
///
/// Where edges are split does not depend on the tolerance, which only says when to stop: of two
/// tolerances with the same levels the smaller one gives all vertices of the other, and more.
/// At forks alone: the inner vertices of the plain tiles are moved, edges at them are split, and
/// edges are flipped, the best first: but for rounding, no numbers of tiles or nodes decide.
///
/// `firm`: nodes of the plain tiles at whose tiles nothing is flipped; empty if there are none.
/// Without flips, straightened tiles cover what the plain ones did.
/// Cost: O(n log n) for n tiles in the result, in practice.
[[nodiscard]] BentTiles bend(const BentSlab& slab, std::span<const OutlinePoint> outlines,
                             const TileSet& plain, const Fineness& fineness,
                             std::vector<bool> firm = {});

}  // namespace loft
