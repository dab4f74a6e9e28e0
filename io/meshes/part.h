// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "reconstruct/stack.h"
#include "reconstruct/surface.h"

namespace loft::io {

/// A surface and the name of the structure it shows; empty where the stack has no labels.
/// Precondition of all writers: no deleted elements (else call garbage_collection() first).
struct Part {
  std::string label;
  const Surface* surface = nullptr;
  std::optional<Colour> colour = {};  ///< that the source gives it; none: by its name
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
};

}  // namespace loft::io
