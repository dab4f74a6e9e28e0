// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "mesh/mesh.h"

namespace loft::io {

/// A mesh and the name of the structure it shows; empty where the file names none.
struct LabelledMesh {
  std::string label;
  Mesh mesh;

  friend bool operator==(const LabelledMesh&, const LabelledMesh&) = default;
};

}  // namespace loft::io
