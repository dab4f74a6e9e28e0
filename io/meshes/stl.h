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

/// Writes binary STL, all parts in one solid (the format knows no more). Coordinates are `float`,
/// about seven digits: where the extent is small against the coordinates, neighbouring vertices
/// fall together; choose another format then.
void write_stl(std::ostream& out, std::span<const Part> parts, const WriteOptions& options = {});

/// Reads binary and ASCII STL. Triangles that meet along an edge share its vertices again (see
/// sew_seams()); where more than two meet, as where parts of a solid touch, the format has lost
/// which of them belong together, and the edge is not manifold. Always one mesh. Throws InputError
/// that names `name` and the place.
[[nodiscard]] std::vector<LabelledMesh> read_stl(const std::string& content, std::string_view name);

}  // namespace loft::io
