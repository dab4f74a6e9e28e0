// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "io/meshes/labelled_mesh.h"
#include "reconstruct/stack.h"

namespace loft::app {

/// How much of a stack's contours is found in a mesh, exactly.
struct Fidelity {
  std::size_t vertices = 0;
  std::size_t missing_vertices = 0;
  std::size_t edges = 0;
  std::size_t missing_edges = 0;
  std::optional<std::string> first_missing;  ///< where: `slice 2 (z = 1.5) contour 0 point 7`

  [[nodiscard]] bool is_complete() const { return missing_vertices == 0 && missing_edges == 0; }
};

/// Looks up every contour vertex (the same coordinates in the world, bit for bit) and every contour
/// edge (an edge of the mesh between those vertices, or two with its midpoint) in all the meshes
/// together. Contours whose points are all in one line and edges without length do not count: no
/// surface can keep them. With `within` above 0 a vertex of the mesh counts for every contour
/// vertex that is no farther from it, at the same height where slices are level; an edge counts for
/// those between any two such vertices. Cost: O(n log n), with the number of vertices within.
[[nodiscard]] Fidelity compare(const Stack& stack, std::span<const io::LabelledMesh> meshes,
                               double within = 0);

}  // namespace loft::app
