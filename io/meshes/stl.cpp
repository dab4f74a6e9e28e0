// SPDX-License-Identifier: MIT
#include "io/meshes/stl.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

#include "io/bytes/little_endian.h"
#include "io/bytes/text_reader.h"
#include "io/meshes/polygons.h"
#include "io/meshes/seam.h"
#include "io/version.h"
#include "mesh/vec3.h"
#include "reconstruct/defect.h"
#include "reconstruct/number_text.h"

namespace loft::io {

namespace {

constexpr std::size_t header_size = 80;
constexpr std::size_t preamble_size = header_size + sizeof(std::uint32_t);
constexpr std::size_t record_size = 12 * sizeof(float) + 2;

/// The unit normal, or zeros where there is none, which STL readers take as "work it out".
Vec3 unit_normal(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 n = cross(minus(b, a), minus(c, a));
  const double length = std::hypot(n[0], n[1], n[2]);
  if (!(length > 0)) return {};
  return {n[0] / length, n[1] / length, n[2] / length};
}

char* put_place(char* place, const Vec3& coordinates) {
  for (const double coordinate : coordinates) place = put(place, static_cast<float>(coordinate));
  return place;
}

/// Without the origin that the coordinates are about.
Mesh moved(Mesh mesh, const Vec3& origin) {
  for (Vec3& point : mesh.points) point = minus(point, origin);
  return mesh;
}

/// What made the file and, if coordinates are not about 0, the place that they are about, as far as
/// there is room for it.
std::string header(const WriteOptions& options) {
  std::string result(generator());
  if (options.origin) {
    std::string origin = " origin";
    for (const double coordinate : *options.origin) origin += ' ' + exact(coordinate);
    if (result.size() + origin.size() <= header_size) result += origin;
  }
  result.resize(header_size, '\0');
  return result;
}

char* put_faces(char* place, const Mesh& mesh) {
  for (const auto& [i, j, k] : mesh.faces) {
    const Vec3& a = mesh.points[i];
    const Vec3& b = mesh.points[j];
    const Vec3& c = mesh.points[k];
    for (const Vec3& entry : {unit_normal(a, b, c), a, b, c}) place = put_place(place, entry);
    place = put(place, std::uint16_t{0});
  }
  return place;
}

}  // namespace

void write_stl(std::ostream& out, std::span<const Part> parts, const WriteOptions& options) {
  std::size_t face_count = 0;
  for (const Part& part : parts) face_count += part.surface->n_faces();
  if (face_count > 0xffff'ffff) throw Error("more triangles than an STL file can count");

  std::string bytes(preamble_size + face_count * record_size, '\0');
  bytes.replace(0, header_size, header(options));
  char* place = put(bytes.data() + header_size, static_cast<std::uint32_t>(face_count));
  for (const Part& part : parts)
    place = put_faces(place, moved(to_mesh(*part.surface), options.origin.value_or(Vec3{})));
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

namespace {

/// The triangles that a binary STL claims to have, where its size fits them.
std::optional<std::size_t> binary_size(const std::string& content) {
  if (content.size() < preamble_size) return std::nullopt;
  const std::size_t count = get<std::uint32_t>(content.data() + header_size);
  if (content.size() < preamble_size + count * record_size) return std::nullopt;
  return count;
}

Mesh read_binary(const std::string& content, std::size_t count) {
  Mesh mesh;
  mesh.points.reserve(3 * count);
  mesh.faces.reserve(count);
  const char* record = content.data() + preamble_size;
  for (std::size_t i = 0; i < count; ++i, record += record_size) {
    const auto first = static_cast<std::uint32_t>(3 * i);
    mesh.faces.push_back({first, first + 1, first + 2});
    for (std::size_t corner = 1; corner <= 3; ++corner) {
      Vec3 point{};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const std::size_t offset = (3 * corner + axis) * sizeof(float);
        point[axis] = static_cast<double>(get<float>(record + offset));
      }
      mesh.points.push_back(point);
    }
  }
  return mesh;
}

Vec3 read_stl_vertex(TextReader& text) {
  if (text.any_word("'vertex'") != "vertex") text.fail("expected 'vertex'");
  const double x = text.any_number("x");
  const double y = text.any_number("y");
  return {x, y, text.any_number("z")};
}

/// Reads from behind `facet` to behind `endfacet`.
void read_facet(TextReader& text, Mesh& mesh) {
  while (text.any_word("'outer loop'") != "loop") continue;
  const auto first = static_cast<std::uint32_t>(mesh.points.size());
  for (int corner = 0; corner < 3; ++corner) mesh.points.push_back(read_stl_vertex(text));
  if (text.any_word("'endloop'") != "endloop")
    text.fail("expected 'endloop'; facets are triangles");
  if (text.any_word("'endfacet'") != "endfacet") text.fail("expected 'endfacet'");
  mesh.faces.push_back({first, first + 1, first + 2});
}

Mesh read_ascii(const std::string& content, std::string_view name) {
  TextReader text(content, name);
  Mesh mesh;
  bool is_complete = false;
  while (text.next_line()) {
    const auto word = text.word();
    if (word == "facet") {
      read_facet(text, mesh);
    } else if (word == "endsolid") {
      is_complete = true;
    } else if (word == "solid") {
      is_complete = false;
    } else {
      text.fail("expected 'facet' or 'endsolid'; is the file cut off?");
    }
  }
  if (!is_complete) text.fail("the file ends before 'endsolid'");
  return mesh;
}

}  // namespace

std::vector<LabelledMesh> read_stl(const std::string& content, std::string_view name) {
  Polygons polygons;
  // A binary header may begin with "solid", too: only its size tells.
  if (const auto count = binary_size(content)) {
    polygons.mesh = read_binary(content, *count);
  } else if (content.starts_with("solid")) {
    polygons.mesh = read_ascii(content, name);
  } else {
    throw InputError(std::string(name) + ": neither ASCII STL nor binary of the size it says; " +
                     "is it cut off?");
  }
  require_valid(polygons.mesh, name);
  polygons.mesh = sew_seams(polygons.mesh);
  return split(std::move(polygons));
}

}  // namespace loft::io
