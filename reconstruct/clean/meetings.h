// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "cdt/triangulation.h"

namespace loft {

/// How a ring of a slice, a closed constraint, gets in the way of another one or of itself.
struct Meeting {
  enum class Kind {
    crossing,     ///< some area is enclosed by both; by one ring: more than once, or backwards
    doubled,      ///< a ring runs out and back along the same line
    shared_side,  ///< two rings run along the same line
    upon_side,    ///< a corner of one ring is on a side of the other
    covered,      ///< a ring that has the region on both sides, everywhere
  };
  Kind kind;
  cdt::ConstraintId one;    ///< the smaller one
  cdt::ConstraintId other;  ///< the same as `one` where a ring meets itself
  cdt::Point place;         ///< the first of its places
  std::size_t places = 1;   ///< of a crossing: where one outline comes into the other
  /// Of a crossing, area enclosed by both. Area that more than two rings enclose counts once, for
  /// the first two of them. Of covered, what the ring encloses.
  double area = 0;
};

/// All meetings of rings in a triangulation that has nothing but closed constraints, sorted by
/// kind, then by rings. `is_inside` tells of each triangle whether it is in the region that the
/// rings enclose. Rings that are corner to corner, or one inside the other, do not meet.
/// Cost: O(n) where rings do not meet, else with how many enclose the same place.
[[nodiscard]] std::vector<Meeting> find_meetings(const cdt::Triangulation& mesh,
                                                 const std::vector<bool>& is_inside);

}  // namespace loft
