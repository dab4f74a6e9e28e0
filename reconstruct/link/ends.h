// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "reconstruct/link/pieces.h"

namespace loft {

/// What ends in a slab, and goes on beside where it ends. Sizes are Footprint::radius.

/// A slab as its neighbours see it.
struct SlabPieces {
  const Pieces* pieces = nullptr;  ///< null: there is no such slab
  double gap = 0;                  ///< its height
};

/// Two ends of a slab that belong together.
struct EndLink {
  std::uint32_t lower = 0;  ///< index of the piece that ends
  std::uint32_t upper = 0;  ///< index of the piece that begins
  LinkReason reason = LinkReason::nearest;

  friend bool operator==(const EndLink&, const EndLink&) = default;
};

/// Matches what ends in a slab with what begins there: parts with parts, cavities with cavities.
///
/// Where the slab below or above tells how a part moves (it was, or will be, a piece of one part in
/// each slice, or the nearest match of two ends there), the part's place is predicted from there;
/// predictions of both sides must agree with where the parts are within half the sum of their
/// radii plus a quarter of the shift; the shift is at most `max_shift`, or 4 times the sum. Where
/// nothing is known of either, as at the first and last slice and beside forks, the shift is at
/// most twice the sum; parts that are alone in the slab beside, too, are then no match. Areas
/// differ by a factor of 2 at most. A part that shrinks as fast as a round end would is not linked:
/// a paraboloid's area is in proportion to the distance from its top, which lies somewhere in the
/// slab. Of the possible pairs those with the least error (distance, and ratio of areas) are taken,
/// each end once; equal ones by place. A function of the slab's two slices and one on either side.
[[nodiscard]] std::vector<EndLink> match_ends(const SlabPieces& below, const SlabPieces& slab,
                                              const SlabPieces& above,
                                              std::optional<double> max_shift,
                                              std::span<const EndLink> forbidden);

/// Tiles matched ends as one piece each, the upper part moved over the lower one. If they then
/// cover less than 0.4 of what they cover together, and one is hollow, as where a shell closes, its
/// outlines are joined and its holes by themselves, or the holes end. If that makes too little of
/// an overlap, too, they are moved as their outlines match (move_by_loops()); else the match is
/// left out, unless an order asks for it. Where these tiles meet nothing else (exact test), they
/// take the place of the two ends.
void link_ends(const Region& lower, const Region& upper, TileSet& tiles, Pieces& pieces,
               std::span<const EndLink> links);

}  // namespace loft
