// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "reconstruct/mesh.h"

namespace loft {

/// How well shaped the faces of a mesh are. Angles in degrees: each face counts by its smallest
/// one, which is 60 at best. All 0 without faces.
struct Angles {
  double smallest = 0;
  double fifth_percentile = 0;  ///< one face in 20 has a smaller one
  double median = 0;
  double worst_aspect = 0;  ///< longest side over the height on it, 1 at best; see aspect()
};

/// Size and shape of a mesh. Lengths in its own units.
struct Measures {
  std::size_t vertices = 0;  ///< vertices that a face uses
  std::size_t edges = 0;
  std::size_t faces = 0;
  std::size_t components = 0;  ///< parts connected through edges
  int genus = 0;               ///< sum over the components; meaningful for closed manifolds only
  double area = 0;
  double volume = 0;  ///< signed: positive if faces look outwards
  Angles angles;
};

/// Cost: O(n log n).
[[nodiscard]] Measures measure(const Mesh& mesh);

}  // namespace loft
