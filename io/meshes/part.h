// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "io/meshes/grid.h"
#include "mesh/mesh.h"
#include "reconstruct/stack.h"
#include "reconstruct/surface.h"

namespace loft::io {

/// A closed line at a height, as the source has it, where it is in the world.
struct ContourLine {
  double height = 0;  ///< of its slice
  std::vector<Vec3> points;
};

/// A surface and the name of the structure it shows; empty where the stack has no labels.
/// Precondition of all writers: no deleted elements (else call garbage_collection() first).
struct Part {
  std::string label;
  const Surface* surface = nullptr;
  std::optional<Colour> colour = {};  ///< that the source gives it; none: by its name

  // What is known of it beside that; glTF has a place for it.
  std::string id = {};                     ///< StackLabel::id
  std::string kind = {};                   ///< StackLabel::kind
  std::string source = {};                 ///< the name of its file, without folders
  std::optional<std::size_t> slices = {};  ///< that it is in
  std::vector<ContourLine> contours = {};  ///< to be shown beside it, by height
  bool is_hidden = false;                  ///< until a viewer is told to show it
};

/// A label with what its source tells of it, if it is among those; the surface is still to be
/// added.
[[nodiscard]] Part part_of(std::span<const StackLabel> about, const std::string& label);

/// The contours of a label, where they are in the world, from low to high.
[[nodiscard]] std::vector<ContourLine> contour_lines(const Stack& stack, const std::string& label);

/// How glTF's numbers are made smaller. Not every program reads such files.
enum class Compression {
  none,
  quantize,  ///< 16-bit positions on one grid for all parts, 8-bit normals
  meshopt,   ///< that, and packed by meshoptimizer's codec
};

/// What writers need to know beside the surfaces.
struct WriteOptions {
  /// The length of one unit of the input. glTF is in metres; the other formats keep the input's
  /// unit, whatever it is.
  double metres_per_unit = 0.001;
  /// The place that formats with `float` coordinates write about. None: glTF about the middle of
  /// all parts (it is in the nodes), STL about 0.
  std::optional<Vec3> origin = {};
  /// Where the surfaces come from and how they were made, for the formats that have a place for it
  /// (glTF: `asset.extras`). Give no absolute paths and no times: same input, same bytes.
  std::vector<std::string> sources = {};
  std::map<std::string, std::string> settings = {};
  Compression compression = Compression::none;  ///< of glTF
  /// That compressed glTF is rounded to: about the origin, in metres, y up. None: by the parts.
  std::optional<Grid> grid = {};
  /// The file of materials that an OBJ names, beside it (materials.h); empty: none.
  std::string materials = {};
  /// That test what rounding does to surfaces; 0: as many as the machine has. The bytes do not
  /// depend on it.
  unsigned threads = 1;
};

}  // namespace loft::io
