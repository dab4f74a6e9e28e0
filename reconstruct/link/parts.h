// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "reconstruct/clean/region.h"

namespace loft {

/// The parts of a slab's two regions (connected components: an outer loop and the holes in it), and
/// which of one slice overlap which of the other. Contours within contact() of each other are taken
/// to meet: that is no overlap.
struct PartGraph {
  struct Overlap {
    std::uint32_t lower;
    std::uint32_t upper;

    friend auto operator<=>(const Overlap&, const Overlap&) = default;
  };

  std::vector<std::uint32_t> lower_part;  ///< of each loop of the lower region
  std::vector<std::uint32_t> upper_part;  ///< of each loop of the upper region
  std::uint32_t lower_count = 0;          ///< number of parts
  std::uint32_t upper_count = 0;
  std::vector<Overlap> overlaps;  ///< sorted, each once; with an area in common
  std::vector<double> areas;      ///< of each overlap
};

/// Cost: that of the CDT of both slices.
[[nodiscard]] PartGraph find_parts(const Region& lower, const Region& upper);

}  // namespace loft
