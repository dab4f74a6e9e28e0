// SPDX-License-Identifier: MIT
#include "io/rounding/rounding_faults.h"

#include <algorithm>
#include <array>

#include "mesh/check.h"
#include "mesh/predicates.h"
#include "mesh/triangle_pairs.h"

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
                        RoundingFaults& faults) {
  std::vector<Corners> places;
  std::vector<TrianglePairs::Vertices> vertices;
  for (const std::uint32_t f : faces) {
    places.push_back(corners(mesh, f));
    vertices.push_back(mesh.faces[f]);
  }
  const TrianglePairs pairs(places, vertices, mesh.points.size());
  const bool are_all = pairs.all_of([&](std::uint32_t i, std::uint32_t j) {
    if (!triangles_meet(places[i], places[j])) return true;
    ++faults.count;
    add_corners(vertices[i], faults);
    add_corners(vertices[j], faults);
    return faults.count < most_intersections(mesh);
  });
  static_cast<void>(are_all);
}

}  // namespace

RoundingFaults find_faults(const Mesh& mesh, const PlaceCounts& counts) {
  RoundingFaults faults;
  find_shared_places(mesh, counts, faults);
  find_meeting_faces(mesh, find_flat_faces(mesh, faults), faults);
  std::ranges::sort(faults.vertices);
  const auto rest = std::ranges::unique(faults.vertices);
  faults.vertices.erase(rest.begin(), rest.end());
  return faults;
}

}  // namespace loft::io
