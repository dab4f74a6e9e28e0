// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "cdt/point.h"
#include "reconstruct/clean/region.h"

namespace loft {

/// The loops of a region as they go through an overlay: each side from its first vertex through
/// those vertices of the other slice that it touches. Point i is where segment i starts.
struct LoopPaths {
  std::vector<cdt::Point> points;          ///< loop after loop
  std::vector<std::uint32_t> loop_starts;  ///< where each loop starts in them, and their number
  std::vector<std::uint32_t> side_starts;  ///< the same of each side, in the order of loop_vertices
};

/// The loops of two slices, the upper ones moved by `shift`, so that what is no further apart than
/// `contact` meets exactly: vertices of the upper slice are where those of the lower are, and sides
/// go through vertices of the other slice beside them. Then all vertices are moved by some share of
/// `contact`, if `stir` is not 0, for each value in other directions: what was in one line but for
/// rounding is so no longer. None if vertices of one slice would become one. Cost: O(n log n).
[[nodiscard]] std::optional<std::array<LoopPaths, 2>> meet_exactly(const Region& lower,
                                                                   const Region& upper,
                                                                   cdt::Point shift, double contact,
                                                                   unsigned stir = 0);

}  // namespace loft
