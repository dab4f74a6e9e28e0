// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "reconstruct/clean/region.h"
#include "reconstruct/sew/sewing.h"

namespace loft {

/// A region as flat triangles: the constrained Delaunay triangulation of its loops. Indices are
/// those of its points, counter-clockwise seen from above.
[[nodiscard]] std::vector<std::array<std::uint32_t, 3>> flat_cap(const Region& region);

/// The flat caps of a stack, as layers below its lowest slab and above its highest one. `slab` and
/// `slice`: what the vertices and faces that sewing may add to a cap will say.
[[nodiscard]] Layer bottom_cap(const Region& region);
[[nodiscard]] Layer top_cap(const Region& region, std::uint32_t slab, std::uint32_t slice);

}  // namespace loft
