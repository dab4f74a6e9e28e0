// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "io/meshes/part.h"
#include "mesh/box3.h"

namespace loft::io {

/// The smallest box around all vertices; no_box without any. Cost: O(n).
[[nodiscard]] Box3 extent(std::span<const Part> parts);

/// The middle of a box; of no_box the origin.
[[nodiscard]] Vec3 centre_of(const Box3& box);

}  // namespace loft::io
