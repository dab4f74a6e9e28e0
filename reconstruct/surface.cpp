// SPDX-License-Identifier: MIT
#include "reconstruct/surface.h"

#include <cassert>

namespace loft {

Mesh to_mesh(const Surface& surface) {
  Mesh mesh;
  mesh.points.reserve(surface.n_vertices());
  for (const auto vertex : surface.vertices()) {
    const OpenMesh::Vec3d& p = surface.point(vertex);
    mesh.points.push_back({p[0], p[1], p[2]});
  }
  mesh.faces.reserve(surface.n_faces());
  for (const auto face : surface.faces()) {
    std::array<std::uint32_t, 3> corners{};
    std::size_t corner = 0;
    for (const auto vertex : face.vertices()) {
      assert(corner < 3);
      corners[corner++] = static_cast<std::uint32_t>(vertex.idx());
    }
    mesh.faces.push_back(corners);
  }
  return mesh;
}

}  // namespace loft
