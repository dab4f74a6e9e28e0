// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "mesh/mesh.h"
#include "reconstruct/stack.h"

namespace loft::io {

/// A mesh and the name of the structure it shows; empty where the file names none.
struct LabelledMesh {
  std::string label;
  Mesh mesh;
  std::optional<Colour> colour = {};  ///< none: the file has none, or several

  friend bool operator==(const LabelledMesh&, const LabelledMesh&) = default;
};

}  // namespace loft::io
