// SPDX-License-Identifier: MIT
#pragma once

#include <ostream>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/meshes/labelled_mesh.h"
#include "io/meshes/part.h"

namespace loft::io {

/// Writes Wavefront OBJ: one object (`o NAME`) a part, coordinates with as many digits as give them
/// back exactly.
void write_obj(std::ostream& out, std::span<const Part> parts, const WriteOptions& options = {});

/// Reads the vertices and faces of an OBJ; polygons become triangle fans. Objects split the mesh
/// only in files that loft wrote, since elsewhere an object need not be a solid.
/// Throws InputError that names `name` and line.
[[nodiscard]] std::vector<LabelledMesh> read_obj(const std::string& content, std::string_view name);

}  // namespace loft::io
