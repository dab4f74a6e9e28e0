// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cstdint>

#include "io/little_endian.h"
#include "io/ply.h"
#include "io/text.h"
#include "io/version.h"
#include "reconstruct/defect.h"

namespace loft::io {

namespace {

bool has_labels(std::span<const Part> parts) {
  return parts.size() > 1 || (parts.size() == 1 && !parts[0].label.empty());
}

struct Counts {
  std::size_t vertices = 0;
  std::size_t faces = 0;
};

Counts count(std::span<const Part> parts) {
  Counts result;
  for (const Part& part : parts) {
    result.vertices += part.surface->n_vertices();
    result.faces += part.surface->n_faces();
  }
  return result;
}

std::string header(std::span<const Part> parts, Counts counts) {
  std::string text = "ply\nformat binary_little_endian 1.0\ncomment " + std::string(generator());
  text += '\n';
  const bool labelled = has_labels(parts);
  for (std::size_t i = 0; labelled && i < parts.size(); ++i) {
    text += "comment label " + std::to_string(i) + ' ' + one_line(parts[i].label) + '\n';
  }
  text += "element vertex " + std::to_string(counts.vertices) +
          "\nproperty double x\nproperty double y\nproperty double z\nproperty uchar kind\n"
          "property int slice\nproperty int contour\nproperty int point\n";
  if (labelled) text += "property int label\n";
  text += "element face " + std::to_string(counts.faces) +
          "\nproperty list uchar int vertex_indices\nproperty uchar kind\nproperty int slab\n";
  if (labelled) text += "property int label\n";
  return text + "end_header\n";
}

/// Appends `count` records of `size` bytes and hands out the place of the first.
char* grow(std::string& bytes, std::size_t count, std::size_t size) {
  const std::size_t before = bytes.size();
  bytes.resize(before + count * size);
  return bytes.data() + before;
}

/// `Origin::none` turns into -1.
std::int32_t index_or_none(std::uint32_t index) { return static_cast<std::int32_t>(index); }

void append_vertices(std::string& bytes, const Surface& surface, std::int32_t label,
                     bool labelled) {
  const std::size_t size = 3 * 8 + 1 + 3 * 4 + (labelled ? 4 : 0);
  char* place = grow(bytes, surface.n_vertices(), size);
  for (const auto vertex : surface.vertices()) {
    const auto& point = surface.point(vertex);
    const Origin& origin = surface.data(vertex).origin;
    for (const double coordinate : {point[0], point[1], point[2]}) place = put(place, coordinate);
    place = put(place, static_cast<std::uint8_t>(origin.kind));
    for (const std::uint32_t index : {origin.slice, origin.contour, origin.point}) {
      place = put(place, index_or_none(index));
    }
    if (labelled) place = put(place, label);
  }
}

void append_faces(std::string& bytes, const Surface& surface, std::size_t first_vertex,
                  std::int32_t label, bool labelled) {
  const std::size_t size = 1 + 3 * 4 + 1 + 4 + (labelled ? 4 : 0);
  char* place = grow(bytes, surface.n_faces(), size);
  for (const auto face : surface.faces()) {
    place = put(place, std::uint8_t{3});
    for (const auto vertex : surface.fv_range(face)) {
      const std::size_t index = first_vertex + static_cast<std::size_t>(vertex.idx());
      place = put(place, static_cast<std::int32_t>(index));
    }
    place = put(place, static_cast<std::uint8_t>(surface.data(face).kind));
    place = put(place, index_or_none(surface.data(face).slab));
    if (labelled) place = put(place, label);
  }
}

}  // namespace

void write_ply(std::ostream& out, std::span<const Part> parts, const WriteOptions&) {
  const Counts counts = count(parts);
  if (counts.vertices > 0x7fff'ffff) throw Error("more vertices than a PLY file can number");
  const bool labelled = has_labels(parts);
  std::string bytes = header(parts, counts);
  bytes.reserve(bytes.size() + counts.vertices * 41 + counts.faces * 22);
  std::int32_t label = 0;
  for (const Part& part : parts) append_vertices(bytes, *part.surface, label++, labelled);
  label = 0;
  std::size_t first_vertex = 0;
  for (const Part& part : parts) {
    append_faces(bytes, *part.surface, first_vertex, label++, labelled);
    first_vertex += part.surface->n_vertices();
  }
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

}  // namespace loft::io
