// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "cdt/point.h"
#include "reconstruct/clean/region.h"

namespace loft {

/// A short stretch of an edge of a loop.
struct Stretch {
  cdt::Point middle;
  cdt::Point normal;  ///< of length 1, out of the region
  double length = 0;
  std::uint32_t from = 0;  ///< the edge, by indices of the region's points
  std::uint32_t to = 0;
  double share = 0;  ///< of the way from `from` to `to` at which the middle is
};

/// A loop as stretches of about a length: its edges, or equal parts of them. They do not depend on
/// where the loop begins. Cost: O(stretches).
[[nodiscard]] std::vector<Stretch> stretches_by_edges(const Region& region, std::uint32_t loop,
                                                      double length);

/// How long a loop is.
[[nodiscard]] double length(const Region& region, std::uint32_t loop);
/// The length of all loops.
[[nodiscard]] double perimeter(const Region& region);

}  // namespace loft
