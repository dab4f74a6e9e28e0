// SPDX-License-Identifier: MIT
#include "io/meshes/obj.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "io/bytes/text.h"
#include "io/bytes/text_reader.h"
#include "io/meshes/materials.h"
#include "io/meshes/polygons.h"
#include "io/version.h"
#include "reconstruct/number_text.h"

namespace loft::io {

namespace {

void append_vertices(std::string& text, const Mesh& mesh) {
  for (const Vec3& point : mesh.points) {
    text += 'v';
    for (const double coordinate : point) {
      text += ' ';
      append_number(text, coordinate);
    }
    text += '\n';
  }
}

void append_faces(std::string& text, const Mesh& mesh, std::size_t first_vertex) {
  for (const auto& face : mesh.faces) {
    text += 'f';
    for (const std::uint32_t corner : face) {
      text += ' ';
      append_number(text, first_vertex + corner);
    }
    text += '\n';
  }
}

}  // namespace

void write_obj(std::ostream& out, std::span<const Part> parts, const WriteOptions& options) {
  const bool has_file = !options.materials.empty();
  const std::vector<std::string> materials = material_names(parts);
  std::string text = "# " + std::string(generator()) + '\n';
  if (has_file) text += "mtllib " + options.materials + '\n';
  std::size_t first_vertex = 1;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const Mesh mesh = to_mesh(*parts[i].surface);
    if (!parts[i].label.empty()) text += "o " + one_line(parts[i].label) + '\n';
    append_vertices(text, mesh);
    if (has_file) text += "usemtl " + materials[i] + '\n';
    append_faces(text, mesh, first_vertex);
    first_vertex += mesh.points.size();
  }
  out.write(text.data(), static_cast<std::streamsize>(text.size()));
}

namespace {

/// The index in front of the first `/`: from 1, or from the last vertex backwards if negative.
std::uint32_t to_corner(std::string_view word, std::size_t vertex_count, const TextReader& text) {
  const std::int64_t number = text.to_integer(word.substr(0, word.find('/')), "a vertex number");
  const auto count = static_cast<std::int64_t>(vertex_count);
  const std::int64_t index = number < 0 ? count + number : number - 1;
  if (number == 0 || index < 0 || index >= 0xffff'ffff) {
    text.fail("there is no vertex " + std::to_string(number));
  }
  return static_cast<std::uint32_t>(index);
}

void read_face(TextReader& text, std::uint32_t label, Polygons& polygons) {
  std::vector<std::uint32_t> corners;
  while (const auto word = text.word()) {
    corners.push_back(to_corner(*word, polygons.mesh.points.size(), text));
  }
  if (corners.size() < 3) text.fail("a face of " + std::to_string(corners.size()) + " corners");
  polygons.add(corners, label);
}

Vec3 read_vertex(TextReader& text) {
  const double x = text.number("x");
  const double y = text.number("y");
  return {x, y, text.number("z")};
}

}  // namespace

std::vector<LabelledMesh> read_obj(const std::string& content, std::string_view name) {
  const bool is_ours = content.starts_with("# loft ");
  TextReader text(content, name);
  text.set_comments();
  Polygons polygons;
  std::uint32_t label = 0;
  while (text.next_line()) {
    const auto keyword = text.word();
    if (keyword == "v") {
      polygons.mesh.points.push_back(read_vertex(text));
    } else if (keyword == "f") {
      read_face(text, label, polygons);
    } else if (keyword == "o" && is_ours) {
      label = static_cast<std::uint32_t>(polygons.labels.size());
      polygons.labels.emplace_back(text.rest());
    }
  }
  require_valid(polygons.mesh, name);
  return split(std::move(polygons));
}

}  // namespace loft::io
