// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "reconstruct/mesh.h"
#include "reconstruct/surface.h"

namespace loft {

/// Size and shape of a mesh. Lengths in its own units.
struct Measures {
  std::size_t vertices = 0;  ///< vertices that a face uses
  std::size_t edges = 0;
  std::size_t faces = 0;
  std::size_t components = 0;  ///< parts connected through edges
  int genus = 0;               ///< sum over the components; meaningful for closed manifolds only
  double area = 0;
  double volume = 0;  ///< signed: positive if faces look outwards
};

/// Cost: O(n log n).
[[nodiscard]] Measures measure(const Mesh& mesh);
/// The same, from the surface's own connectivity. Precondition: no deleted elements.
/// Cost: O(n).
[[nodiscard]] Measures measure(const Surface& surface);

}  // namespace loft
