// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "reconstruct/registration/outline.h"

namespace loft {

/// Two stretches, one of each loop, that belong together.
struct Match {
  std::uint32_t lower;
  std::uint32_t upper;

  friend bool operator==(const Match&, const Match&) = default;
};

/// Which stretches of two loops belong together: cyclic dynamic time warping (Sakoe and Chiba,
/// 1978). Of all ways to go once round both loops at the same time, each at its own pace, the one
/// with the least sum of costs: of two stretches, the square of their distance and
/// `direction_weight` (a length, squared) times the difference of their directions (1 - cosine).
/// Every stretch has a partner at least; some have many, where a loop has nothing that is like
/// them.
///
/// First between about `coarse` places of each loop, wherever one starts; then between all
/// stretches, in a band around that. Cost: O(stretches * band), and O(coarse^3) at worst: where one
/// start is much better than others, these are left once they cannot cost less.
[[nodiscard]] std::vector<Match> match_outlines(std::span<const Stretch> lower,
                                                std::span<const Stretch> upper,
                                                double direction_weight, double pace_weight,
                                                std::size_t coarse);

}  // namespace loft
