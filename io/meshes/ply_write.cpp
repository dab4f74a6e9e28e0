// SPDX-License-Identifier: MIT
#include <cstdint>
#include <optional>

#include "io/bytes/text.h"
#include "io/meshes/label_colour.h"
#include "io/meshes/ply.h"
#include "io/meshes/ply_records.h"
#include "io/version.h"
#include "reconstruct/defect.h"

namespace loft::io {

bool ply_has_labels(std::span<const std::string> labels) {
  return labels.size() > 1 || (labels.size() == 1 && !labels[0].empty());
}

std::string ply_header(std::span<const std::string> labels, bool is_labelled, PlyCounts counts) {
  if (counts.vertices > 0x7fff'ffff) throw Error("more vertices than a PLY file can number");
  std::string text = "ply\nformat binary_little_endian 1.0\ncomment " + std::string(generator());
  text += '\n';
  for (std::size_t i = 0; is_labelled && i < labels.size(); ++i) {
    text += "comment label " + std::to_string(i) + ' ' + one_line(labels[i]) + '\n';
  }
  text += "element vertex " + std::to_string(counts.vertices) +
          "\nproperty double x\nproperty double y\nproperty double z\nproperty uchar kind\n"
          "property int slice\nproperty int contour\nproperty int point\n";
  if (is_labelled)
    text += "property int label\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n";
  text += "element face " + std::to_string(counts.faces) +
          "\nproperty list uchar int vertex_indices\nproperty uchar kind\nproperty int slab\n";
  if (is_labelled) text += "property int label\n";
  return text + "end_header\n";
}

namespace {

/// Appends `count` records of `size` bytes and hands out the place of the first.
char* grow(std::string& bytes, std::size_t count, std::size_t size) {
  const std::size_t before = bytes.size();
  bytes.resize(before + count * size);
  return bytes.data() + before;
}

void append_vertices(std::string& bytes, const Surface& surface,
                     const std::optional<PlyLabel>& label) {
  char* place = grow(bytes, surface.n_vertices(), ply_vertex_size(label.has_value()));
  for (const auto vertex : surface.vertices()) {
    const auto& p = surface.point(vertex);
    place = put_ply_vertex(place, {p[0], p[1], p[2]}, surface.data(vertex).origin, label);
  }
}

void append_faces(std::string& bytes, const Surface& surface, std::size_t first_vertex,
                  const std::optional<PlyLabel>& label) {
  char* place = grow(bytes, surface.n_faces(), ply_face_size(label.has_value()));
  for (const auto face : surface.faces()) {
    std::array<std::uint32_t, 3> corners{};
    std::size_t i = 0;
    for (const auto vertex : surface.fv_range(face))
      corners[i++] =
          static_cast<std::uint32_t>(first_vertex + static_cast<std::size_t>(vertex.idx()));
    const auto& data = surface.data(face);
    place = put_ply_face(place, corners, data.kind, data.slab, label);
  }
}

}  // namespace

void write_ply(std::ostream& out, std::span<const Part> parts, const WriteOptions&) {
  PlyCounts counts;
  std::vector<std::string> labels;
  for (const Part& part : parts) {
    counts.vertices += part.surface->n_vertices();
    counts.faces += part.surface->n_faces();
    labels.push_back(part.label);
  }
  const bool is_labelled = ply_has_labels(labels);
  const auto label_of = [&](std::size_t part) {
    return is_labelled
               ? std::optional(PlyLabel{static_cast<std::int32_t>(part), colour_of(parts[part])})
               : std::nullopt;
  };
  std::string bytes = ply_header(labels, is_labelled, counts);
  bytes.reserve(bytes.size() + counts.vertices * ply_vertex_size(is_labelled) +
                counts.faces * ply_face_size(is_labelled));
  for (std::size_t i = 0; i < parts.size(); ++i)
    append_vertices(bytes, *parts[i].surface, label_of(i));
  std::size_t first_vertex = 0;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    append_faces(bytes, *parts[i].surface, first_vertex, label_of(i));
    first_vertex += parts[i].surface->n_vertices();
  }
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

}  // namespace loft::io
