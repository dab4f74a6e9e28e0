// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "reconstruct/mesh.h"

namespace loft {

/// Size and shape of a mesh. Lengths in its own units.
struct Measures {
  std::size_t vertices = 0;  ///< vertices that a face uses
  std::size_t edges = 0;
  std::size_t faces = 0;
  std::size_t components = 0;  ///< parts connected through edges
  /// The sum over the components, an open one with its holes closed; meaningful for manifolds only.
  int genus = 0;
  double area = 0;
  double volume = 0;  ///< signed: positive if faces look outwards
};

/// Cost: O(n log n).
[[nodiscard]] Measures measure(const Mesh& mesh);

}  // namespace loft
