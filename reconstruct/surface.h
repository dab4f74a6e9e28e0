// SPDX-License-Identifier: MIT
#pragma once

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <cstdint>

#include "reconstruct/mesh.h"

namespace loft {

/// How a vertex of the surface came about.
enum class VertexKind : std::uint8_t {
  contour,   ///< a point of an input contour, unchanged
  cleaning,  ///< made in a slice by cleaning: where contours of that slice cross
  crossing,  ///< where contour edges of two neighbouring slices cross in projection
  steiner,   ///< added between two slices, in forks and ends
};

/// Where a vertex of the surface comes from. Indices are those of the input.
struct Origin {
  static constexpr std::uint32_t none = 0xffff'ffff;

  VertexKind kind = VertexKind::steiner;
  std::uint32_t slice = none;    ///< contour, cleaning: its slice; otherwise the slice below it
  std::uint32_t contour = none;  ///< contour only
  std::uint32_t point = none;    ///< contour only

  friend bool operator==(const Origin&, const Origin&) = default;
};

/// What part of the surface a face belongs to.
enum class FaceKind : std::uint8_t {
  sheet,       ///< between two slices, over a part that is inside one of them only
  wall,        ///< between two slices, upright on a contour edge
  bottom_cap,  ///< closes the lowest slice
  top_cap,     ///< closes the highest slice
};

struct SurfaceTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
  VertexAttributes(OpenMesh::Attributes::Status);
  EdgeAttributes(OpenMesh::Attributes::Status);
  HalfedgeAttributes(OpenMesh::Attributes::Status | OpenMesh::Attributes::PrevHalfedge);
  FaceAttributes(OpenMesh::Attributes::Status);
  VertexTraits {
    Origin origin;
  };
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

}  // namespace loft
