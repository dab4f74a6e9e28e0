// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace loft::io {

/// Loops that edges make, by their vertices.
struct EdgeLoops {
  std::vector<std::vector<std::uint32_t>> loops;
  std::size_t open_lines = 0;  ///< that end, and were left out
};

/// Joins edges, in any order and direction, to loops that meet themselves nowhere. Each begins with
/// the first of its edges, in that edge's direction. Cost: O(n log n) for n edges, whichever
/// numbers their vertices have.
[[nodiscard]] EdgeLoops join_edges(std::vector<std::array<std::uint32_t, 2>> edges);

}  // namespace loft::io
