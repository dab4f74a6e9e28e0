// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "io/rounding/place_counts.h"
#include "mesh/meeting_faces.h"
#include "mesh/mesh.h"

namespace loft::io {

/// What is wrong with a surface whose places are rounded: faces without area, pairs of faces that
/// meet, vertices that share their place, components that are turned inside out.
struct RoundingFaults {
  std::size_t count = 0;
  std::vector<std::uint32_t> vertices;  ///< that have to do with one, in order
};

/// All faults, by exact tests; of pairs of faces as many as check() finds. `exact`: the mesh before
/// its places were rounded. `counts`: of all vertices that must not share a place.
/// Cost: O(n log n) in practice, most of it in what `run` gets to do.
[[nodiscard]] RoundingFaults find_faults(const Mesh& rounded, const Mesh& exact,
                                         const PlaceCounts& counts, const Runner& run);

}  // namespace loft::io
