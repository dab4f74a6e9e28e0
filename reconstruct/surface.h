// SPDX-License-Identifier: MIT
#pragma once

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <cstdint>
#include <vector>

#include "mesh/check.h"
#include "mesh/measure.h"
#include "mesh/mesh.h"
#include "reconstruct/origin.h"

namespace loft {

struct SurfaceTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
  VertexAttributes(OpenMesh::Attributes::Status);
  EdgeAttributes(OpenMesh::Attributes::Status);
  HalfedgeAttributes(OpenMesh::Attributes::Status | OpenMesh::Attributes::PrevHalfedge);
  FaceAttributes(OpenMesh::Attributes::Status);
  VertexTraits { Origin origin; };
  FaceTraits {
    FaceKind kind = FaceKind::sheet;
    std::uint32_t slab = 0;  ///< number of slices below it, less one
  };
};

/// The reconstructed surface: an OpenMesh triangle mesh with double coordinates in the units of
/// the input, slices across z. Each vertex knows its Origin (`surface.data(v).origin`), each face
/// its part (`surface.data(f).kind`).
using Surface = OpenMesh::TriMesh_ArrayKernelT<SurfaceTraits>;

/// The surface as plain points and faces, in the order of its vertices and faces.
/// Precondition: no deleted elements (else call garbage_collection() first).
[[nodiscard]] Mesh to_mesh(const Surface& surface);

/// All faults of the surface, see check(const Mesh&). Precondition: no deleted elements.
[[nodiscard]] std::vector<Finding> check(const Surface& surface);

/// Its size and shape, from its own connectivity. Precondition: no deleted elements.
/// Cost: O(n).
[[nodiscard]] Measures measure(const Surface& surface);

}  // namespace loft
