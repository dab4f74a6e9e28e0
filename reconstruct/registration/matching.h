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
/// with the least integral, over the ways along both loops (each 1 long), of a cost: of two
/// stretches, the square of their distance and `direction_weight` (a length, squared) times the
/// difference of their directions (1 - cosine); and of `pace_weight` over what one way is longer
/// than the other. Where some are the least but for rounding, the pairs of all of them. Every
/// stretch has a partner at least; some have many, where a loop has nothing that is like them.
///
/// So that does not depend, but for rounding, on where the loops begin, which way round they go,
/// and which of them is the lower one; it does where a way round is as good as one far from it.
///
/// Cost: that of n m log m pairs (Maes, 1990); of loops with more than some hundred stretches first
/// between runs of them, then in a band around that, in which all is proportional to n + m.
[[nodiscard]] std::vector<Match> match_outlines(std::span<const Stretch> lower,
                                                std::span<const Stretch> upper,
                                                double direction_weight, double pace_weight);

}  // namespace loft
