// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "io/bytes/little_endian.h"
#include "mesh/mesh.h"
#include "reconstruct/origin.h"
#include "reconstruct/stack.h"

namespace loft::io {

/// The parts of the PLY files that write_ply() describes.
struct PlyCounts {
  std::size_t vertices = 0;
  std::size_t faces = 0;
};

/// What records say of their part.
struct PlyLabel {
  std::int32_t number = 0;
  Colour colour;
};

/// `labels` has one for each part. Throws Error beyond what a file can number.
[[nodiscard]] std::string ply_header(std::span<const std::string> labels, bool is_labelled,
                                     PlyCounts counts);

/// Whether records have a label: not where there is a single part without one.
[[nodiscard]] bool ply_has_labels(std::span<const std::string> labels);

[[nodiscard]] constexpr std::size_t ply_vertex_size(bool is_labelled) {
  return 3 * 8 + 1 + 3 * 4 + (is_labelled ? 4 + 3 : 0);
}
[[nodiscard]] constexpr std::size_t ply_face_size(bool is_labelled) {
  return 1 + 3 * 4 + 1 + 4 + (is_labelled ? 4 : 0);
}
/// Where the corners of a face are in its record, one behind the other.
inline constexpr std::size_t ply_face_corners = 1;

/// Puts a vertex at `place`; returns the place behind it. `Origin::none` turns into -1.
inline char* put_ply_vertex(char* place, const Vec3& p, const Origin& origin,
                            const std::optional<PlyLabel>& label) {
  for (const double coordinate : p) place = put(place, coordinate);
  place = put(place, static_cast<std::uint8_t>(origin.kind));
  for (const std::uint32_t index : {origin.slice, origin.contour, origin.point})
    place = put(place, index);
  if (!label) return place;
  place = put(place, label->number);
  for (const std::uint8_t share : {label->colour.red, label->colour.green, label->colour.blue})
    place = put(place, share);
  return place;
}

/// Puts a face at `place`; returns the place behind it.
inline char* put_ply_face(char* place, const std::array<std::uint32_t, 3>& corners, FaceKind kind,
                          std::uint32_t slab, const std::optional<PlyLabel>& label) {
  place = put(place, std::uint8_t{3});
  for (const std::uint32_t corner : corners) place = put(place, corner);
  place = put(place, static_cast<std::uint8_t>(kind));
  place = put(place, slab);
  return label ? put(place, label->number) : place;
}

}  // namespace loft::io
