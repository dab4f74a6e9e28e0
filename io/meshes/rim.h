// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

#include "reconstruct/surface.h"

namespace loft::io {

/// Whether the surface is open: it has edges with one face. Cost: O(n).
[[nodiscard]] inline bool has_rim(const Surface& surface) {
  return std::ranges::any_of(surface.halfedges(),
                             [&](const auto side) { return surface.is_boundary(side); });
}

}  // namespace loft::io
