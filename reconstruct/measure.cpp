// SPDX-License-Identifier: MIT
#include "reconstruct/measure.h"

#include <algorithm>
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

/// Euler: vertices - edges + faces = 2 components - 2 genus - rims.
int genus(const Measures& m, std::size_t rims) {
  const auto euler =
      static_cast<std::int64_t>(m.vertices + m.faces) - static_cast<std::int64_t>(m.edges);
  return static_cast<int>(
      (2 * static_cast<std::int64_t>(m.components) - euler - static_cast<std::int64_t>(rims)) / 2);
}

/// Seen from a corner of the mesh, so that its place in space costs no accuracy.
void measure_area_and_volume(const Mesh& mesh, std::span<const std::uint32_t> faces, Measures& m) {
  if (faces.empty()) return;
  const Vec3 origin = mesh.points[mesh.faces[faces.front()][0]];
  for (const std::uint32_t face : faces) {
    const auto [i, j, k] = mesh.faces[face];
    const Vec3& a = mesh.points[i];
    const Vec3 normal = cross(minus(mesh.points[j], a), minus(mesh.points[k], a));
    m.area += std::sqrt(dot(normal, normal)) / 2;
    m.volume += dot(normal, minus(a, origin)) / 6;
  }
}

}  // namespace

Measures measure(const Mesh& mesh) {
  const std::vector<std::uint32_t> faces = proper_faces(mesh);
  const Edges edges(mesh, faces);
  Measures result;
  result.vertices = count_used_vertices(mesh, faces);
  result.edges = edges.size();
  result.faces = faces.size();
  result.components = count_components(mesh, faces, edges);
  result.genus = genus(result, count_rims(mesh, edges));
  measure_area_and_volume(mesh, faces, result);
  return result;
}

}  // namespace loft
