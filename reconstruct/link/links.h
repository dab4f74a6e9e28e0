// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "reconstruct/link/pieces.h"
#include "reconstruct/registration/registration.h"

namespace loft {

/// Correspondence beyond overlap: parts that move sideways between
/// two slices, by a good deal of their width or by more. Sizes are Footprint::radius.

/// From the centroid of a piece's upper footprint to that of its lower one, rounded to 2^-40 of it:
/// points moved by it lose little, and it does not depend on the order of sums.
[[nodiscard]] cdt::Point offset(const Piece& piece);

/// The tiles of a piece by itself, its upper part moved by its shift; and how far the two parts
/// overlap then.
struct Moved {
  TileSet tiles;
  Piece piece;
  double difference = 0;
};

/// The tiles of a piece by itself that has as many outlines and as many holes in both slices, moved
/// over each other as these match (reconstruct/registration), from where it is or from over each
/// other, whichever leaves less of a difference. None if there are no valid ones, or if these are
/// not wanted.
[[nodiscard]] std::optional<Moved> move_registered(
    const Region& lower, const Region& upper, const Piece& piece,
    const IsWanted& is_wanted = [](const Registered&) { return true; });

/// Moves the upper contours of pieces over their lower ones by the offset of their centroids, where
/// a piece is one part in each slice, both cover less than 0.6 of what they cover together, and the
/// move takes away at least 0.3 of their difference. Such a piece would be pinched by overlay
/// alone. Before that, what overlay has torn is untangled (untangle.h). A function of the two
/// slices.
void slide(const Region& lower, const Region& upper, TileSet& tiles, Pieces& pieces,
           std::optional<double> max_shift);

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
/// an overlap, too, the match is left out, unless an order asks for it. Where these tiles meet
/// nothing else (exact test), they take the place of the two ends.
void link_ends(const Region& lower, const Region& upper, TileSet& tiles, Pieces& pieces,
               std::span<const EndLink> links);

/// The share of what two footprints cover together that both cover, by the area between them.
[[nodiscard]] double overlap(const Piece& piece, double difference);

}  // namespace loft
