// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/meshes/labelled_mesh.h"
#include "mesh/mesh.h"

namespace loft::io {

/// What a mesh reader gathers: points, polygons cut into triangles, and what they belong to.
struct Polygons {
  Mesh mesh;
  std::vector<std::uint32_t> label_of;  ///< one a face, index into `labels`; empty: all are 0
  std::vector<std::string> labels;      ///< by number; may be shorter than the numbers used
  std::vector<std::optional<Colour>> colours;  ///< one a face, as it was added; empty: none has any

  /// Adds a polygon as a fan of triangles. Precondition: three corners at least.
  void add(std::span<const std::uint32_t> corners, std::uint32_t label = 0);
  /// Gives all faces that have none that colour.
  void fill(std::optional<Colour> colour) { colours.resize(mesh.faces.size(), colour); }
};

/// Throws InputError if a face names a point that is not there, or if there is no face at all.
void require_valid(const Mesh& mesh, std::string_view name);

/// One mesh a label that has faces, by number; only the points that its faces use, where there is
/// more than one label; with the colour that all of its faces have. Precondition: the indices are
/// valid.
[[nodiscard]] std::vector<LabelledMesh> split(Polygons polygons);

}  // namespace loft::io
