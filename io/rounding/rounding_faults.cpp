// SPDX-License-Identifier: MIT
#include "io/rounding/rounding_faults.h"

#include <algorithm>
#include <array>

#include "mesh/adjacency.h"
#include "mesh/check.h"
#include "mesh/predicates.h"
#include "mesh/vec3.h"

namespace loft::io {

namespace {

void add_corners(const std::array<std::uint32_t, 3>& face, RoundingFaults& faults) {
  faults.vertices.insert(faults.vertices.end(), face.begin(), face.end());
}

/// Vertices at places where there are others.
void find_shared_places(const Mesh& mesh, const PlaceCounts& counts, RoundingFaults& faults) {
  for (std::uint32_t v = 0; v < mesh.points.size(); ++v) {
    if (counts.at(mesh.points[v]) < 2) continue;
    ++faults.count;
    faults.vertices.push_back(v);
  }
}

/// The faces with area.
std::vector<std::uint32_t> find_flat_faces(const Mesh& mesh, RoundingFaults& faults) {
  std::vector<std::uint32_t> others;
  for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
    const auto [a, b, c] = corners(mesh, f);
    if (!collinear(a, b, c)) {
      others.push_back(f);
      continue;
    }
    ++faults.count;
    add_corners(mesh.faces[f], faults);
  }
  return others;
}

void find_meeting_faces(const Mesh& mesh, const std::vector<std::uint32_t>& faces,
                        const Runner& run, RoundingFaults& faults) {
  const std::size_t all = most_intersections(mesh);
  const std::size_t most = faults.count < all ? all - faults.count : 1;
  for (const auto& [f, g] : meeting_faces(mesh, faces, most, run)) {
    ++faults.count;
    add_corners(mesh.faces[f], faults);
    add_corners(mesh.faces[g], faults);
  }
}

/// Six times the volume of each component, at its first vertex; about that vertex, so that what is
/// small and far away has one.
std::vector<double> volumes(const Mesh& mesh, DisjointSets& component) {
  std::vector<double> result(mesh.points.size());
  for (const auto& face : mesh.faces) {
    const std::uint32_t first = component.find(face[0]);
    const Vec3& origin = mesh.points[first];
    result[first] +=
        dot(minus(mesh.points[face[0]], origin),
            cross(minus(mesh.points[face[1]], origin), minus(mesh.points[face[2]], origin)));
  }
  return result;
}

/// Things thinner than what rounding moves.
void find_turned_components(const Mesh& rounded, const Mesh& exact, RoundingFaults& faults) {
  DisjointSets component(exact.points.size());
  for (const auto& [a, b, c] : exact.faces) {
    component.unite(a, b);
    component.unite(b, c);
  }
  const std::vector<double> before = volumes(exact, component);
  const std::vector<double> after = volumes(rounded, component);
  for (std::size_t v = 0; v < before.size(); ++v)
    if (before[v] * after[v] < 0) ++faults.count;
}

}  // namespace

RoundingFaults find_faults(const Mesh& rounded, const Mesh& exact, const PlaceCounts& counts,
                           const Runner& run) {
  RoundingFaults faults;
  find_shared_places(rounded, counts, faults);
  find_meeting_faces(rounded, find_flat_faces(rounded, faults), run, faults);
  find_turned_components(rounded, exact, faults);
  std::ranges::sort(faults.vertices);
  faults.vertices.erase(std::unique(faults.vertices.begin(), faults.vertices.end()),
                        faults.vertices.end());
  return faults;
}

}  // namespace loft::io
