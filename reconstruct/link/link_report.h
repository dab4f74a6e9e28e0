// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cdt/point.h"
#include "reconstruct/link/pieces.h"
#include "reconstruct/options.h"

namespace loft {

/// What happens to the parts that a piece joins, on the way up.
enum class LinkKind : std::uint8_t {
  link,    ///< one goes on as one
  split,   ///< one becomes several
  merge,   ///< several become one
  tangle,  ///< several become several, and cannot be told apart
  birth,   ///< it begins in this slab
  death,   ///< it ends in this slab
};

/// A piece of a slab: one surface between the slices, and the contours that it joins.
struct LinkReport {
  LinkKind kind = LinkKind::link;
  bool is_solid = true;  ///< false: the parts are cavities
  LinkReason reason = LinkReason::overlap;
  std::vector<ContourId> lower;  ///< contours of the input, sorted; cleaning may leave some of none
  std::vector<ContourId> upper;
  cdt::Point lower_place;  ///< centroid of what they enclose; (0, 0) if there are none
  cdt::Point upper_place;
  double shift = 0;    ///< how far the upper contours were moved to be tiled over the lower ones
  double turn = 0;     ///< and how far the lower ones turn to be as they are, degrees, to the left
  double overlap = 0;  ///< area in both slices by area in either, after that; 0 for an end
  double confidence = 0;  ///< overlap * r / (r + shift + r * |turn|); r: the smaller radius
};

/// How sure the surface is between two slices.
struct SlabReport {
  std::uint32_t lower_slice = 0;  ///< index in the input; Origin::none beyond a domed end
  std::uint32_t upper_slice = 0;
  double lower_z = 0;
  double upper_z = 0;
  double sheet_area = 0;  ///< of the tiles over what is inside one slice only: they may lie flat
  double wall_area = 0;   ///< of the tiles upright on contours, where both slices agree
  double overlap = 0;     ///< area inside both slices by area inside either, after shifts
  double shift = 0;       ///< the farthest
  double confidence =
      0;  ///< mean of the links', by the area of their tiles: 1 extrusion, 0 ends only
  std::vector<LinkReport> links;
};

/// Of the tiles as linking leaves them. Cost: O(tiles).
[[nodiscard]] SlabReport report_slab(const Region& lower, const Region& upper, const TileSet& tiles,
                                     const Pieces& pieces);
/// Slab i is between regions i and i + 1.
[[nodiscard]] std::vector<SlabReport> report_slabs(std::span<const Region> regions,
                                                   std::span<const TileSet> tiles,
                                                   std::span<const Pieces> pieces);

/// The names that reports print: `link`, `split`, ...; `overlap`, `slide`, ...
[[nodiscard]] const char* name(LinkKind kind);
[[nodiscard]] const char* name(LinkReason reason);

}  // namespace loft
