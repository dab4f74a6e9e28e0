// SPDX-License-Identifier: MIT
#include "reconstruct/measure.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

#include "reconstruct/adjacency.h"
#include "reconstruct/triangle_shape.h"
#include "reconstruct/vec3.h"

namespace loft {

namespace {

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

/// Euler: vertices - edges + faces = 2 components - 2 genus.
int genus(const Measures& m) {
  const auto euler =
      static_cast<std::int64_t>(m.vertices + m.faces) - static_cast<std::int64_t>(m.edges);
  return static_cast<int>((2 * static_cast<std::int64_t>(m.components) - euler) / 2);
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

Angles measure_angles(const Mesh& mesh, std::span<const std::uint32_t> faces) {
  if (faces.empty()) return {};
  Angles result;
  std::vector<double> angles;
  for (const std::uint32_t face : faces) {
    const auto [i, j, k] = mesh.faces[face];
    const Corners corners{mesh.points[i], mesh.points[j], mesh.points[k]};
    angles.push_back(std::asin(smallest_sine(corners)) * 180 / std::numbers::pi);
    result.worst_aspect = std::max(result.worst_aspect, aspect(corners));
  }
  std::ranges::sort(angles);
  result.smallest = angles.front();
  result.fifth_percentile = angles[angles.size() / 20];
  result.median = angles[angles.size() / 2];
  return result;
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
  result.genus = genus(result);
  measure_area_and_volume(mesh, faces, result);
  result.angles = measure_angles(mesh, faces);
  return result;
}

}  // namespace loft
