// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "mesh/box_tree.h"
#include "reconstruct/clean/region.h"
#include "reconstruct/link/pieces.h"
#include "reconstruct/plane/segment_tree.h"
#include "reconstruct/registration/outline.h"

namespace loft {

/// What an end lies beside: the trunk that it is a branch of.
struct Trunk {
  std::uint32_t piece;  ///< which has it, in the other slice
  cdt::Point way;       ///< that brings the end over its rim
};

/// An end, as it looks for what it lies beside.
struct LooseEnd {
  std::uint32_t piece;
  Level level = Level::lower;  ///< the slice of its contours
  /// The loops of that slice that it is one piece with in the slab on the other side.
  std::span<const std::uint32_t> joined = {};
  /// How far it moves through the slab, if that is known.
  std::optional<cdt::Point> expected = {};
};

/// Finds which part of the other slice an end of a slab lies beside: where branches leave at once,
/// they do not overlap what they come from, but are next to it.
///
/// The gap between the two outlines must be no more than the end's radius, or, if the part ends,
/// too, than the part's; from where the end is expected, if that is known, a quarter of its own
/// radius. A part that goes on must come nearer to the end, by half, than what it goes on as; and
/// that must be no part of the end's own piece in the slab beside, else there would be a handle.
/// Of a part that ends an end has no less than 0.05 of the area, of the end a part at least half.
/// Of several the nearest counts; none, if two are.
class BesideFinder {
 public:
  /// Keeps references. Cost: O(n log n) in the pieces.
  BesideFinder(const Region& lower, const Region& upper, const Pieces& pieces);

  /// Cost: O(n log n) for each outline that is looked at, once.
  [[nodiscard]] std::optional<Trunk> find(const LooseEnd& end);

 private:
  struct Outline {
    std::vector<Stretch> stretches;
    SegmentTree tree;
    double length;
  };
  struct Gap {
    double width;
    cdt::Point way;  // across it, a unit vector
  };

  [[nodiscard]] const Region& region(Level level) const {
    return level == Level::lower ? lower_ : upper_;
  }
  const Outline& outline(std::uint32_t piece, Level level);
  [[nodiscard]] std::optional<double> reach(const LooseEnd& end, const Piece& target) const;
  [[nodiscard]] bool is_apart(const LooseEnd& end, const Piece& target) const;
  [[nodiscard]] std::optional<Gap> gap(const LooseEnd& end, std::uint32_t target);

  const Region& lower_;
  const Region& upper_;
  const Pieces& pieces_;
  std::array<std::vector<std::uint32_t>, 2> targets_;  // pieces with a footprint, by level
  std::vector<BoxTree> trees_;                         // around their reach
  std::map<std::pair<std::uint32_t, Level>, Outline> outlines_;
};

}  // namespace loft
