// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "tests/cdt/edits.h"

namespace loft::cdt {

/// Where the points of random edits are.
enum class Ground {
  grid_8,           ///< integers 0 ... 7
  grid_4,           ///< integers 0 ... 3: nearly everything coincides
  decimals,         ///< thousandths, which are no doubles
  near_parallel,    ///< ends at x = 0 and 1, y within 1e-6
  far_from_origin,  ///< sevenths beyond 5e6
  nearly_equal,     ///< around few places, 1e-13 apart and less
  beside_lines,     ///< one to three decimals, half of them within 8 last places of others' lines
  near_zero,        ///< lines across 0, and points 1e-15 from there
  flush,            ///< along a few slanted lines in decimals, as rooms along a corridor
};
inline constexpr Ground all_grounds[] = {
    Ground::grid_8,        Ground::grid_4,          Ground::decimals,
    Ground::near_parallel, Ground::far_from_origin, Ground::nearly_equal,
    Ground::beside_lines,  Ground::near_zero,       Ground::flush};

[[nodiscard]] constexpr bool is_grid(Ground ground) {
  return ground == Ground::grid_8 || ground == Ground::grid_4;
}
[[nodiscard]] const char* name_of(Ground ground);

/// A script of so many edits: polylines, spikes, out and back, stars, rectangles, points and copies
/// of what is there come, change and go, around so many at a time.
[[nodiscard]] Script random_script(std::uint64_t seed, Ground ground, std::size_t edits,
                                   std::size_t population);

}  // namespace loft::cdt
