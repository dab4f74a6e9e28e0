// SPDX-License-Identifier: MIT
// For sources of io/gltf only, as it shows tinygltf.
#pragma once

#include <tiny_gltf.h>

#include "io/meshes/part.h"

namespace loft::io {

/// What a node says of its part: `label`, and what is known of `id`, `kind`, `source`, `slices`;
/// `area_m2`, and where it is closed `volume_m3`.
[[nodiscard]] tinygltf::Value part_extras(const Part& part, bool is_open, double metres_per_unit);

/// What a node of lines says of them: `label`, `contours_of` (the name of the part's node),
/// `heights` of its slices, in the unit of the source, and `vertices`, how many lie in each.
[[nodiscard]] tinygltf::Value contour_extras(const Part& part, const std::string& name);

}  // namespace loft::io
