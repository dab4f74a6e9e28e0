// SPDX-License-Identifier: MIT
#include "reconstruct/surface.h"

#include <cassert>
#include <cstddef>
#include <vector>

#include "mesh/adjacency.h"

namespace loft {

namespace {

std::size_t count_components(const Surface& surface) {
  DisjointSets sets(surface.n_faces());
  for (const auto edge : surface.edges()) {
    const auto h = surface.halfedge_handle(edge, 0);
    const auto g = surface.halfedge_handle(edge, 1);
    if (surface.is_boundary(h) || surface.is_boundary(g)) continue;
    sets.unite(static_cast<std::uint32_t>(surface.face_handle(h).idx()),
               static_cast<std::uint32_t>(surface.face_handle(g).idx()));
  }
  return sets.count();
}

/// The holes of an open surface: chains of edges with one face.
std::size_t count_rims(const Surface& surface) {
  std::vector<bool> is_done(surface.n_halfedges());
  std::size_t count = 0;
  for (const auto first : surface.halfedges()) {
    if (!surface.is_boundary(first) || is_done[static_cast<std::size_t>(first.idx())]) continue;
    ++count;
    auto h = static_cast<Surface::HalfedgeHandle>(first);
    do {
      is_done[static_cast<std::size_t>(h.idx())] = true;
      h = surface.next_halfedge_handle(h);
    } while (h != first);
  }
  return count;
}

}  // namespace

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

std::vector<Finding> check(const Surface& surface) { return check(to_mesh(surface)); }

Measures measure(const Surface& surface) {
  Measures result;
  result.vertices = surface.n_vertices();
  result.edges = surface.n_edges();
  result.faces = surface.n_faces();
  result.components = count_components(surface);
  result.genus = genus(result, count_rims(surface));
  FaceSum sum;
  for (const auto face : surface.faces()) {
    Corners corners;
    auto h = surface.halfedge_handle(face);
    for (Vec3& corner : corners) {
      const auto& p = surface.point(surface.to_vertex_handle(h));
      corner = {p[0], p[1], p[2]};
      h = surface.next_halfedge_handle(h);
    }
    sum.add(corners);
  }
  sum.put_into(result);
  return result;
}

}  // namespace loft
