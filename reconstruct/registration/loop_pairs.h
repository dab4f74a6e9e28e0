// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "reconstruct/clean/region.h"

namespace loft {

/// A loop of each of two regions that belong together.
struct LoopPair {
  std::uint32_t lower;
  std::uint32_t upper;

  friend bool operator==(const LoopPair&, const LoopPair&) = default;
};

/// Outer loops with outer ones and holes with holes, those first that are nearest by their places,
/// once the upper region is moved back by `offset`, and by their sizes. None if a loop is left
/// over. Cost: O(n^2) in the number of loops.
[[nodiscard]] std::optional<std::vector<LoopPair>> pair_loops(const Region& lower,
                                                              const Region& upper,
                                                              cdt::Point offset);

}  // namespace loft
