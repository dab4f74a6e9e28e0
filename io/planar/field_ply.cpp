// SPDX-License-Identifier: MIT
#include "io/planar/field_ply.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <ostream>
#include <string>
#include <vector>

#include "io/bytes/little_endian.h"

namespace loft::io {

namespace {

using cdt::Triangulation;

struct SurfaceVertex {
  cdt::Point place;
  double value = 0;
  friend auto operator<=>(const SurfaceVertex&, const SurfaceVertex&) = default;
};

SurfaceVertex vertex_at(const fields::Field& field, cdt::EdgeId corner) {
  return {field.mesh().point(field.mesh().from(corner)), field.corner_value(corner)};
}

/// The triangles that have values, each with its smallest corner first.
std::vector<std::array<SurfaceVertex, 3>> surface_of(const fields::Field& field) {
  std::vector<std::array<SurfaceVertex, 3>> triangles;
  const Triangulation& mesh = field.mesh();
  for (std::uint32_t i = 0; i < mesh.triangle_bound(); ++i) {
    const cdt::TriangleId t(i);
    if (!mesh.is_triangle(t) || mesh.is_infinite(t)) continue;
    std::array<SurfaceVertex, 3> corners{};
    for (unsigned k = 0; k < 3; ++k) corners[k] = vertex_at(field, Triangulation::edge(t, k));
    if (std::ranges::any_of(corners, [](const SurfaceVertex& v) { return v.value != v.value; }))
      continue;
    std::rotate(corners.begin(), std::ranges::min_element(corners, {}, &SurfaceVertex::place),
                corners.end());
    triangles.push_back(corners);
  }
  std::ranges::sort(triangles, [](const auto& a, const auto& b) { return a < b; });
  return triangles;
}

}  // namespace

void write_field_ply(std::ostream& out, const fields::Field& field) {
  const auto triangles = surface_of(field);
  std::vector<SurfaceVertex> vertices;
  for (const auto& corners : triangles)
    vertices.insert(vertices.end(), corners.begin(), corners.end());
  const auto is_less = [](const SurfaceVertex& a, const SurfaceVertex& b) { return a < b; };
  std::ranges::sort(vertices, is_less);
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());

  out << "ply\nformat binary_little_endian 1.0\nelement vertex " << vertices.size()
      << "\nproperty double x\nproperty double y\nproperty double z\nproperty double "
         "value\nelement face "
      << triangles.size() << "\nproperty list uchar int vertex_indices\nend_header\n";
  std::string bytes(vertices.size() * 4 * sizeof(double) + triangles.size() * 13, '\0');
  char* place = bytes.data();
  for (const SurfaceVertex& v : vertices)
    for (const double number : {v.place.x, v.place.y, v.value, v.value}) place = put(place, number);
  for (const auto& corners : triangles) {
    place = put(place, std::uint8_t{3});
    for (const SurfaceVertex& v : corners) {
      const auto found = std::ranges::lower_bound(vertices, v, is_less);
      place = put(place, static_cast<std::int32_t>(found - vertices.begin()));
    }
  }
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

}  // namespace loft::io
