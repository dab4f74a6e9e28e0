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

/// Rings that run along each other all the way round: every corner of each is within `tolerance` of
/// the other one's outline. Of several such rings the one with the smallest places stays, so that
/// in normal form (normal_form.h) their order does not matter.
/// Cost: O(n log n), and for each pair of rings whose boxes are the same within the tolerance.
[[nodiscard]] std::vector<NearCopy> find_near_copies(
    std::span<const std::span<const cdt::Point>> rings, double tolerance);

}  // namespace loft
