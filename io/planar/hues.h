// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "io/planar/palette.h"
#include "io/planar/planar_mesh.h"

namespace loft::io {

/// A hue for every region and every constraint of a mesh. Regions with the same key share one;
/// neighbouring regions with different keys differ, as far as the hues reach. A constraint has that
/// of the region that it alone encloses. Cost: O(n log n).
struct Hues {
  std::vector<std::uint8_t> of_region;
  std::vector<std::uint8_t> of_constraint;
};
[[nodiscard]] Hues choose_hues(const PlanarMesh& mesh);

/// What a region is filled with.
[[nodiscard]] Colour fill_of(const PlanarMesh::Region& region, std::size_t hue);

}  // namespace loft::io
