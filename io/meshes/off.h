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

/// Writes OFF text, coordinates with as many digits as give them back exactly. The format knows no
/// parts: all of them become one mesh, labels are lost.
void write_off(std::ostream& out, std::span<const Part> parts, const WriteOptions& options = {});

/// Reads OFF text (also COFF, NOFF, ...: colours, normals and texture coordinates are left out);
/// polygons become triangle fans. Always one mesh. Throws InputError that names `name` and line.
[[nodiscard]] std::vector<LabelledMesh> read_off(const std::string& content, std::string_view name);

}  // namespace loft::io
