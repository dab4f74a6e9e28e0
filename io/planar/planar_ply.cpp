// SPDX-License-Identifier: MIT
#include "io/planar/planar_ply.h"

#include <cstddef>
#include <cstdint>
#include <string>

#include "io/bytes/little_endian.h"
#include "io/bytes/text.h"
#include "io/planar/hues.h"
#include "io/version.h"

namespace loft::io {

namespace {

std::string header(const PlanarMesh& mesh) {
  std::string text = "ply\nformat binary_little_endian 1.0\ncomment " + std::string(generator());
  text += '\n';
  for (std::size_t i = 0; i < mesh.constraints.size(); ++i) {
    const std::string& name = mesh.constraints[i].name;
    if (name.empty()) continue;
    text += "comment constraint " + std::to_string(i) + ' ' + one_line(name) + '\n';
  }
  text += "element vertex " + std::to_string(mesh.points.size()) +
          "\nproperty double x\nproperty double y\nproperty double z\n";
  text += "element face " + std::to_string(mesh.triangles.size()) +
          "\nproperty list uchar int vertex_indices\nproperty int region\n"
          "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  text += "element edge " + std::to_string(mesh.pieces.size()) +
          "\nproperty int vertex1\nproperty int vertex2\nproperty int constraint\n";
  return text + "end_header\n";
}

char* put_index(char* place, std::uint32_t index) {
  return put(place, static_cast<std::int32_t>(index));
}

char* put_vertices(char* place, const PlanarMesh& mesh) {
  for (const cdt::Point& point : mesh.points)
    for (const double coordinate : {point.x, point.y, 0.0}) place = put(place, coordinate);
  return place;
}

char* put_faces(char* place, const PlanarMesh& mesh) {
  const Hues hues = choose_hues(mesh);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const std::uint32_t region = mesh.region_of[t];
    const Colour colour = fill_of(mesh.regions[region], hues.of_region[region]);
    place = put(place, std::uint8_t{3});
    for (const std::uint32_t corner : mesh.triangles[t]) place = put_index(place, corner);
    place = put_index(place, region);
    for (const std::uint8_t part : {colour.red, colour.green, colour.blue})
      place = put(place, part);
  }
  return place;
}

char* put_edges(char* place, const PlanarMesh& mesh) {
  for (const PlanarMesh::Piece& piece : mesh.pieces)
    for (const std::uint32_t index : {piece.from, piece.to, piece.constraint})
      place = put_index(place, index);
  return place;
}

}  // namespace

void write_planar_ply(std::ostream& out, const PlanarMesh& mesh) {
  std::string bytes = header(mesh);
  const std::size_t header_size = bytes.size();
  bytes.resize(header_size + mesh.points.size() * 24 + mesh.triangles.size() * 20 +
               mesh.pieces.size() * 12);
  put_edges(put_faces(put_vertices(bytes.data() + header_size, mesh), mesh), mesh);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

}  // namespace loft::io
