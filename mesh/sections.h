// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cdt/point.h"
#include "mesh/mesh.h"

namespace loft {

/// Where a mesh meets a plane of constant z: closed outlines, the inside on their left if the mesh
/// is oriented outwards.
struct Section {
  double z = 0;
  std::vector<std::vector<cdt::Point>> outlines;
  std::size_t open = 0;  ///< lines that end where the mesh has a rim; they are left out
};

/// The sections of a mesh at some heights, in their order. Which edges a plane meets is decided
/// exactly: a vertex in the plane counts as just above it, so that outlines close wherever the mesh
/// does; each of their points is on an edge of the mesh, rounded, the same for all faces beside it.
/// Preconditions: coordinates and heights are finite, faces name vertices that there are.
/// Cost: O(n log n) and what comes out.
[[nodiscard]] std::vector<Section> sections(const Mesh& mesh, std::span<const double> heights);

}  // namespace loft
