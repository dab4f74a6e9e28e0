// SPDX-License-Identifier: MIT
#include "io/meshes/off.h"

#include <cstddef>
#include <cstdint>
#include <utility>

#include "io/bytes/text_reader.h"
#include "io/meshes/polygons.h"
#include "io/version.h"
#include "reconstruct/number_text.h"

namespace loft::io {

namespace {

void append_off_vertices(std::string& text, const Mesh& mesh) {
  for (const Vec3& point : mesh.points) {
    append_number(text, point[0]);
    text += ' ';
    append_number(text, point[1]);
    text += ' ';
    append_number(text, point[2]);
    text += '\n';
  }
}

void append_off_faces(std::string& text, const Mesh& mesh, std::size_t first_vertex) {
  for (const auto& face : mesh.faces) {
    text += '3';
    for (const std::uint32_t corner : face) {
      text += ' ';
      append_number(text, first_vertex + corner);
    }
    text += '\n';
  }
}

}  // namespace

void write_off(std::ostream& out, std::span<const Part> parts, const WriteOptions&) {
  std::string vertices;
  std::string faces;
  std::size_t vertex_count = 0;
  std::size_t face_count = 0;
  for (const Part& part : parts) {
    const Mesh mesh = to_mesh(*part.surface);
    append_off_vertices(vertices, mesh);
    append_off_faces(faces, mesh, vertex_count);
    vertex_count += mesh.points.size();
    face_count += mesh.faces.size();
  }
  out << "OFF\n# " << generator() << '\n' << vertex_count << ' ' << face_count << " 0\n";
  out.write(vertices.data(), static_cast<std::streamsize>(vertices.size()));
  out.write(faces.data(), static_cast<std::streamsize>(faces.size()));
}

namespace {

std::int64_t read_count(TextReader& text, std::string_view wanted) {
  const std::int64_t count = text.to_integer(text.any_word(wanted), wanted);
  if (count < 0) text.fail("a count below zero");
  return count;
}

/// Goes to the line of the next element.
void require_line(TextReader& text, std::string_view wanted) {
  if (!text.next_line()) text.fail("the file ends where " + std::string(wanted) + " should be");
}

/// `OFF`, with letters in front of it that announce further numbers behind the coordinates.
void read_keyword(TextReader& text) {
  const std::string_view keyword = text.any_word("'OFF'");
  const bool is_known = keyword.ends_with("OFF") && keyword.find('4') == std::string_view::npos &&
                        keyword.find('n') == std::string_view::npos;
  if (!is_known) text.fail("does not begin with 'OFF'");
  if (text.rest() == "BINARY") text.fail("binary OFF cannot be read; convert it to PLY");
}

void read_face(TextReader& text, Polygons& polygons) {
  const std::int64_t count = read_count(text, "a count of corners");
  if (count < 3) text.fail("a face of " + std::to_string(count) + " corners");
  std::vector<std::uint32_t> corners;
  for (std::int64_t i = 0; i < count; ++i) {
    const std::int64_t corner = read_count(text, "a vertex number");
    if (corner >= 0xffff'ffff) text.fail("there is no vertex " + std::to_string(corner));
    corners.push_back(static_cast<std::uint32_t>(corner));
  }
  polygons.add(corners);
}

}  // namespace

std::vector<LabelledMesh> read_off(const std::string& content, std::string_view name) {
  TextReader text(content, name);
  text.set_comments();
  read_keyword(text);
  const std::int64_t vertex_count = read_count(text, "the count of vertices");
  const std::int64_t face_count = read_count(text, "the count of faces");
  Polygons polygons;
  for (std::int64_t i = 0; i < vertex_count; ++i) {
    require_line(text, "a vertex");
    const double x = text.number("x");
    const double y = text.number("y");
    polygons.mesh.points.push_back({x, y, text.number("z")});
  }
  for (std::int64_t i = 0; i < face_count; ++i) {
    require_line(text, "a face");
    read_face(text, polygons);
  }
  require_valid(polygons.mesh, name);
  return split(std::move(polygons));
}

}  // namespace loft::io
