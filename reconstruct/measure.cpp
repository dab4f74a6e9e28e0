// SPDX-License-Identifier: MIT
#include "reconstruct/measure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "reconstruct/adjacency.h"

namespace loft {

namespace {

Vec3 minus(const Vec3& a, const Vec3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double dot(const Vec3& a, const Vec3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

std::size_t count_used_vertices(const Mesh& mesh, std::span<const std::uint32_t> faces) {
  std::vector<bool> is_used(mesh.points.size(), false);
  std::size_t count = 0;
  for (const std::uint32_t face : faces) {
    for (const std::uint32_t vertex : mesh.faces[face]) {
      if (!is_used[vertex]) ++count;
      is_used[vertex] = true;
    }
  }
  return count;
}

std::size_t count_components(const Mesh& mesh, std::span<const std::uint32_t> faces,
                             const Edges& edges) {
  const std::vector<std::uint32_t> component = components(mesh, edges);
  const auto is_first = [&](std::uint32_t face) { return component[face] == face; };
  return static_cast<std::size_t>(std::ranges::count_if(faces, is_first));
}

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
std::size_t count_rims(const Mesh& mesh, const Edges& edges) {
  DisjointSets joined(mesh.points.size());
  std::vector<std::uint32_t> ends;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    if (edges[e].size() != 1) continue;
    joined.unite(edges[e].front().low, edges[e].front().high);
    ends.push_back(edges[e].front().low);
  }
  for (std::uint32_t& end : ends) end = joined.find(end);
  std::ranges::sort(ends);
  return static_cast<std::size_t>(std::unique(ends.begin(), ends.end()) - ends.begin());
}

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

/// Euler: vertices - edges + faces = 2 components - 2 genus - rims.
int genus(const Measures& m, std::size_t rims) {
  const auto euler =
      static_cast<std::int64_t>(m.vertices + m.faces) - static_cast<std::int64_t>(m.edges);
  return static_cast<int>(
      (2 * static_cast<std::int64_t>(m.components) - euler - static_cast<std::int64_t>(rims)) / 2);
}

void FaceSum::add(const Vec3& a, const Vec3& b, const Vec3& c) {
  if (!origin_) origin_ = a;
  const Vec3 normal = cross(minus(b, a), minus(c, a));
  area_ += std::sqrt(dot(normal, normal)) / 2;
  volume_ += dot(normal, minus(a, *origin_)) / 6;
}

Measures measure(const Mesh& mesh) {
  const std::vector<std::uint32_t> faces = proper_faces(mesh);
  const Edges edges(mesh, faces);
  Measures result;
  result.vertices = count_used_vertices(mesh, faces);
  result.edges = edges.size();
  result.faces = faces.size();
  result.components = count_components(mesh, faces, edges);
  result.genus = genus(result, count_rims(mesh, edges));
  FaceSum sum;
  for (const std::uint32_t face : faces) {
    const auto [a, b, c] = mesh.faces[face];
    sum.add(mesh.points[a], mesh.points[b], mesh.points[c]);
  }
  result.area = sum.area();
  result.volume = sum.volume();
  return result;
}

Measures measure(const Surface& surface) {
  Measures result;
  result.vertices = surface.n_vertices();
  result.edges = surface.n_edges();
  result.faces = surface.n_faces();
  result.components = count_components(surface);
  result.genus = genus(result, count_rims(surface));
  FaceSum sum;
  for (const auto face : surface.faces()) {
    std::array<Vec3, 3> corners;
    auto h = surface.halfedge_handle(face);
    for (Vec3& corner : corners) {
      const auto& p = surface.point(surface.to_vertex_handle(h));
      corner = {p[0], p[1], p[2]};
      h = surface.next_halfedge_handle(h);
    }
    sum.add(corners[0], corners[1], corners[2]);
  }
  result.area = sum.area();
  result.volume = sum.volume();
  return result;
}

}  // namespace loft
