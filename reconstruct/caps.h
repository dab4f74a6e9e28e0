// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "reconstruct/region.h"

namespace loft {

/// A region as flat triangles: the constrained Delaunay triangulation of its loops. Indices are
/// those of its points, counter-clockwise seen from above.
[[nodiscard]] std::vector<std::array<std::uint32_t, 3>> flat_cap(const Region& region);

}  // namespace loft
