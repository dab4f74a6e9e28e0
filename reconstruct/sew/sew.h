// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "reconstruct/clean/region.h"
#include "reconstruct/options.h"
#include "reconstruct/surface.h"
#include "reconstruct/tile/tiles.h"

namespace loft {

/// Sews the tiles of a stack into one surface: `slabs[i]` lies between `regions[i]` and
/// `regions[i + 1]`. With Cap::flat the first and the last region close it.
/// The result does not depend on the number of threads; 0 are all there are.
/// Precondition: at least one slab. Cost: O(n).
[[nodiscard]] Surface sew(std::span<const Region* const> regions, std::vector<TileSet> slabs,
                          Cap cap, unsigned threads = 1);
[[nodiscard]] Surface sew(std::span<const Region> regions, std::vector<TileSet> slabs, Cap cap,
                          unsigned threads = 1);
[[nodiscard]] Surface sew(std::span<const Region> regions, std::span<const TileSet> slabs, Cap cap);

}  // namespace loft
