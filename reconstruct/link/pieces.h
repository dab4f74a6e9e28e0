// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "reconstruct/tile/tiles.h"

namespace loft {

/// Why the contours of a piece belong together.
enum class LinkReason : std::uint8_t {
  overlap,     ///< they overlap in projection
  slide,       ///< they overlap, and much more so after a shift
  predicted,   ///< they do not overlap, but lie where a neighbouring slice lets expect them
  nearest,     ///< they do not overlap, but are near, alike, and nothing speaks against it
  order,       ///< a LinkOrder asked for it
  registered,  ///< they overlap, and were moved over each other as their outlines, or places, match
};

/// What of one slice belongs to a piece.
struct Footprint {
  std::vector<std::uint32_t> loops;  ///< of the slice's region, by their smallest points
  std::vector<std::uint32_t> lines;  ///< in which the contours of the other slice end
  std::uint32_t parts = 0;           ///< how many of the loops are outer ones; the rest are holes
  double area = 0;                   ///< enclosed
  double radius = 0;                 ///< of the circle with the area that the outer loops enclose
  cdt::Point centroid;               ///< of that area
  cdt::Point across;  ///< unit vector in which it is narrow; 0 if it is as wide as it is long

  [[nodiscard]] bool is_empty() const { return loops.empty(); }
};

/// Fills in the rest of a footprint whose loops are known. Returns whether its outer loops have
/// the region inside: they bound a part, not a cavity. Precondition: it is not empty.
bool measure(const Region& region, Footprint& footprint);

/// A connected component of a slab's tiles: one surface between the slices, with the contours that
/// it ends in. It is the boundary of a solid piece, or of a cavity in one. A piece with contours of
/// one slice alone is an end: nothing of the other slice overlaps it.
///
/// Pieces are independent of one another: tiled by itself, as if there were no other contours, a
/// piece has the same tiles. So it can be replaced by others that meet nothing else.
struct Piece {
  bool is_solid = true;  ///< false: a cavity
  Footprint lower;
  Footprint upper;
  LinkReason reason = LinkReason::overlap;
  cdt::Point shift;  ///< by which its upper contours were moved over the lower ones to be tiled
  double turn =
      0;  ///< of its lower contours to be as the upper ones, if it was registered; radians
  /// The area between its contours once they were moved as they match, not by the shift alone.
  std::optional<double> registered_difference = {};
  /// Whether the slices tell over each place how it bends: not if it was registered, and overlaps
  /// little.
  bool bends = true;
  cdt::Point lean = {};  ///< of an end: how far its axis goes sideways, by height from its slice

  [[nodiscard]] const Footprint& footprint(Level level) const {
    return level == Level::lower ? lower : upper;
  }
  /// Whether it ends in points and lines of the other slice.
  [[nodiscard]] bool is_tip() const { return !lower.lines.empty() || !upper.lines.empty(); }
  [[nodiscard]] bool is_end() const { return (lower.is_empty() || upper.is_empty()) && !is_tip(); }
};

/// The pieces of a slab, by their smallest contour points.
struct Pieces {
  std::vector<Piece> pieces;
  std::vector<std::uint32_t> of_tile;  ///< the piece of each tile
};

/// Cost: O(tiles), a small part of what it takes to make them.
[[nodiscard]] Pieces find_pieces(const Region& lower, const Region& upper, const TileSet& tiles);

/// The area between the contours of each piece in projection, the upper ones moved by the piece's
/// shift: the symmetric difference of its two footprints (the area of an end). Cost: O(tiles).
[[nodiscard]] std::vector<double> differences(const Region& lower, const Region& upper,
                                              const TileSet& tiles, const Pieces& pieces);

/// Numbers pieces by their smallest contour points; those of the lower slice first.
void sort_pieces(const Region& lower, const Region& upper, Pieces& pieces);

}  // namespace loft
