// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cdt/point.h"

namespace loft {

/// Two rings of a slice that are the same but for rounding: one is to go.
struct NearCopy {
  std::uint32_t kept;
  std::uint32_t dropped;
};

/// Pairs of rings that run along each other all the way round: every corner of each is within
/// `tolerance` of the other one's outline. Of several such rings the one with the smallest places
/// stays, so that their order does not matter. `places`: of each ring, in its normal form.
/// Cost: O(n log n), and for each pair of rings whose boxes are the same within the tolerance.
[[nodiscard]] std::vector<NearCopy> find_near_copies(
    std::span<const std::vector<cdt::Point>> places, double tolerance);

}  // namespace loft
