// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesh/mesh.h"
#include "reconstruct/live/snapshot.h"
#include "reconstruct/surface.h"

namespace loft::io {

/// A surface as a renderer wants it: a normal a vertex, vertices at sharp edges doubled.
struct ShadedMesh {
  std::vector<Vec3> points;
  std::vector<Vec3> normals;  ///< unit length
  std::vector<std::array<std::uint32_t, 3>> faces;
};

/// Smooth normals, weighted by the angle of each face at the vertex; the sides and the two end caps
/// have vertices of their own, so that the edges between them look sharp. Every normal has unit
/// length: where the faces around a vertex cancel, it is that of the widest one.
/// Precondition: no deleted elements. Cost: O(n).
[[nodiscard]] ShadedMesh shade(const Surface& surface);

/// The faces of one slab of a patch, with normals that the slabs beside it in the patch smooth,
/// too.
[[nodiscard]] ShadedMesh shade(const Patch& patch, std::uint32_t slab);

/// Some slabs as one mesh, one after the other; they share no vertices.
struct ShadedSlabs {
  ShadedMesh mesh;
  std::vector<std::size_t> vertices;  ///< how many are each slab's
  std::vector<std::size_t> faces;
};
/// The slabs from `first` up to but not `last` of a patch that has its faces slab by slab, with the
/// same normals. Cost: that of the patch.
[[nodiscard]] ShadedSlabs shade_apart(const Patch& patch, std::uint32_t first, std::uint32_t last);

}  // namespace loft::io
