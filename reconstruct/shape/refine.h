// SPDX-License-Identifier: MIT
#pragma once

#include "reconstruct/clean/region.h"
#include "reconstruct/options.h"
#include "reconstruct/tile/tiles.h"

namespace loft {

/// Splits long edges inside a slab at their middles, so that the surface stays where it is: the
/// longest edge first, if it is the longest of each face at it (Rivara, 1984; Rosenberg and
/// Stenger, 1975: no angle gets smaller than half the smallest one of its tile).
///
/// Guarantees:
/// - Contour edges stay, whole and unsplit, so slabs stay independent of one another. Flat caps lie
///   in a slice, not in a slab: they stay as they are.
/// - No inner edge is longer than `max_edge`, but next to longer contour edges, which bound the
///   tiles beside them: an inner edge that is still longer has a face with an edge at least as
///   long, and so on up to a contour edge. So no inner edge is longer than the longer of `max_edge`
///   and the slab's longest contour edge. (Where rounding leaves no room for a valid split, beside
///   slivers as thin as rounding, an edge stays too.)
/// - As a set of points the surface is the same, up to the rounding of the new vertices; valid
///   tiles stay valid (exact test wherever a middle is rounded).
/// - The result depends on the places of the vertices, not on their numbers.
///
/// Throws InputError if more than 2^28 vertices would be needed. Precondition: max_edge > 0.
/// Cost: O(n log n) for n tiles in the result, in practice.
[[nodiscard]] TileSet split_long_edges(const Region& lower, const Region& upper, TileSet tiles,
                                       double max_edge);

/// Brings the inner edges of a slab near a length, with triangles of good shape (Botsch and
/// Kobbelt, 2004): edges longer than 4/3 of it are split, like those of split_long_edges(); those
/// of new vertices that are shorter than 4/5 are collapsed; edges are flipped, and new vertices
/// moved to the middle of their neighbours, where that makes the smallest angle there larger.
/// Contour vertices stay, however near to each other; so do the vertices that tiling has added.
///
/// All but the splits move the surface a little. They happen only where no triangle turns by more
/// than 10 degrees, and where the new triangles meet nothing (exact test). On stacks cut from known
/// shapes the surface moved by 0.004 of the length in the mean, at most by 0.2.
///
/// Guarantees as for split_long_edges() with 4/3 of the length, but for the set of points. Throws
/// like it. Precondition: target_edge > 0.
[[nodiscard]] TileSet even_out_edges(const Region& lower, const Region& upper, TileSet tiles,
                                     double target_edge);

/// What the options ask for: one of the two, or nothing.
[[nodiscard]] TileSet refine(const Region& lower, const Region& upper, TileSet tiles,
                             const Options& options);

}  // namespace loft
