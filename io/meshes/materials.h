// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <ostream>
#include <span>
#include <string>
#include <vector>

#include "io/meshes/part.h"

namespace loft::io {

/// What the materials of an OBJ are called: labels, one name each, without what ends a name there.
[[nodiscard]] std::vector<std::string> material_names(std::span<const Part> parts);

/// What the file of materials of an OBJ is called, beside it: `heart.mtl` of `heart.obj`. Blanks
/// and their like, at which some readers stop, are replaced, with a number that tells such names
/// apart.
[[nodiscard]] std::string materials_name(const std::filesystem::path& obj);

/// Whether an OBJ has materials: where labels or colours are to be told apart.
[[nodiscard]] bool has_materials(std::span<const Part> parts);

/// Writes Wavefront's MTL: a diffuse colour a part; skins are seen through.
void write_mtl(std::ostream& out, std::span<const Part> parts);

}  // namespace loft::io
