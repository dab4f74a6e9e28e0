// SPDX-License-Identifier: MIT
#include "io/planar/planar_json.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "io/bytes/json_reader.h"
#include "io/version.h"
#include "reconstruct/number_text.h"

namespace loft::io {

namespace {

template <class Number>
void append_list(std::string& text, std::span<const Number> numbers) {
  text += '[';
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (i > 0) text += ',';
    append_number(text, numbers[i]);
  }
  text += ']';
}

/// A member that is a list of `count` items, each on its line.
template <class AppendItem>
void write_list(std::ostream& out, const char* key, std::size_t count, AppendItem append_item) {
  out << ",\n\"" << key << "\":[";
  std::string text;
  for (std::size_t i = 0; i < count; ++i) {
    text.assign(i == 0 ? "\n" : ",\n");
    append_item(text, i);
    out << text;
  }
  out << ']';
}

void write_edges(std::ostream& out, const PlanarMesh& mesh) {
  const std::span<const PlanarMesh::Piece> pieces = mesh.pieces;
  std::size_t i = 0;
  write_list(out, "constrained_edges", count_constrained_edges(mesh), [&](std::string& text, auto) {
    const auto along = mesh.pieces_along(pieces[i].from, pieces[i].to);
    text += "{\"vertices\":[" + std::to_string(pieces[i].from) + ',' +
            std::to_string(pieces[i].to) + "],\"constraints\":";
    std::vector<std::uint32_t> constraints;
    for (const PlanarMesh::Piece& piece : along) constraints.push_back(piece.constraint);
    append_list<std::uint32_t>(text, constraints);
    text += '}';
    i += along.size();
  });
}

void append_constraint(std::string& text, const PlanarMesh::Course& constraint) {
  text += '{';
  if (!constraint.name.empty()) {
    text += "\"name\":";
    append_json_string(text, constraint.name);
    text += ',';
  }
  text += constraint.is_loop() ? "\"closed\":true" : "\"closed\":false";
  text += ",\"vertices\":";
  append_list<std::uint32_t>(text, constraint.vertices);
  text += '}';
}

}  // namespace

void write_planar_json(std::ostream& out, const PlanarMesh& mesh) {
  out << "{\"schema\":\"loft-triangulation\",\"schema_version\":1,\"generator\":\"" << generator()
      << '"';
  write_list(out, "vertices", mesh.points.size(), [&](std::string& text, std::size_t i) {
    const std::array<double, 2> coordinates{mesh.points[i].x, mesh.points[i].y};
    append_list<double>(text, coordinates);
  });
  write_list(out, "triangles", mesh.triangles.size(), [&](std::string& text, std::size_t i) {
    append_list<std::uint32_t>(text, mesh.triangles[i]);
  });
  write_list(out, "regions", mesh.regions.size(), [&](std::string& text, std::size_t i) {
    text += mesh.regions[i].is_odd ? "{\"odd\":true" : "{\"odd\":false";
    text += ",\"triangles\":" + std::to_string(mesh.regions[i].triangles) + '}';
  });
  write_list(out, "region_of", mesh.region_of.size(),
             [&](std::string& text, std::size_t i) { append_number(text, mesh.region_of[i]); });
  write_edges(out, mesh);
  write_list(out, "constraints", mesh.constraints.size(), [&](std::string& text, std::size_t i) {
    append_constraint(text, mesh.constraints[i]);
  });
  out << "}\n";
}

}  // namespace loft::io
