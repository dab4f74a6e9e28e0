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
  const Region* lower = nullptr;   ///< its slices; needed of the slab at hand only
  const Region* upper = nullptr;
};

/// Two ends of a slab that belong together, or an end and what it is a branch of.
struct EndLink {
  std::uint32_t lower = 0;  ///< index of the piece that ends, or whose lower footprint is meant
  std::uint32_t upper = 0;  ///< index of the piece that begins, or whose upper footprint is meant
  LinkReason reason = LinkReason::nearest;
  /// Of an end that lies beside what it is joined to: what brings it over that (BesideFinder).
  std::optional<cdt::Point> lower_way = {};
  std::optional<cdt::Point> upper_way = {};

  [[nodiscard]] bool is_beside() const { return lower_way || upper_way; }
  friend bool operator==(const EndLink&, const EndLink&) = default;
};

/// An end that is linked with nothing, but leans as it came to its slice.
struct EndLean {
  Level level = Level::lower;  ///< the slice that its contours are in
  std::uint32_t loop = 0;      ///< the first of its footprint
  cdt::Point velocity;         ///< of its axis, by height from that slice

  friend bool operator==(const EndLean&, const EndLean&) = default;
};

/// What is to become of the ends of a slab.
struct EndPlan {
  std::vector<EndLink> links;
  std::vector<EndLean> leans;

  [[nodiscard]] bool is_empty() const { return links.empty() && leans.empty(); }
  friend bool operator==(const EndPlan&, const EndPlan&) = default;
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
/// each end once; equal ones by place.
///
/// An end that is no one's match, but goes on in the slab beside, is linked with a part of the
/// other slice that is none (the other index is that piece's) if its predicted place is within
/// that, taken as a circle, or beside it by at most a quarter of its own radius: a branch of a fork
/// that has gone too far to overlap it. What it joins has at least half its area.
///
/// An end that is linked with nothing by then is joined to a part of the other slice that it lies
/// beside (BesideFinder), where it is, or where it is expected if its trend is known; not where
/// these two slices are all there are.
///
/// An end that is linked with nothing leans as it came, if its trend is known: less what its radius
/// has changed by (what shrinks at one side moves its centroid by as much, and goes nowhere), no
/// further than it has been seen to go, and only if its tip would go sideways by more than 0.05 of
/// its radius. A function of the slab's two slices and one on either side.
[[nodiscard]] EndPlan match_ends(const SlabPieces& below, const SlabPieces& slab,
                                 const SlabPieces& above, std::optional<double> max_shift,
                                 std::span<const EndLink> forbidden);

}  // namespace loft
