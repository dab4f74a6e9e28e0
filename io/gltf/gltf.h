// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <ostream>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/meshes/labelled_mesh.h"
#include "io/meshes/part.h"

namespace loft::io {

/// Writes binary glTF 2.0 that passes the Khronos validator with no error and no warning.
///
/// One node and mesh a part, named by its label (`surface` without one); +Y up, so that the slices'
/// z points up: (x, y, z) becomes (x, z, -y); metres. POSITION is `float` relative to the centre of
/// all parts, which goes into the nodes' translation in `double`: coordinates far from zero
/// survive. NORMAL as shade() gives it. Not metallic, a colour a part, double-sided where it is
/// open. `asset.extras` holds `metres_per_unit`, `up`, and the sources and settings of the options.
/// Throws Error where the surfaces are too large for `float` coordinates or 4 GiB.
void write_glb(std::ostream& out, std::span<const Part> parts, const WriteOptions& options = {});

/// The same as glTF JSON, in one file: the buffer is embedded (base64).
void write_gltf(std::ostream& out, std::span<const Part> parts, const WriteOptions& options = {});

/// Reads the triangles of a glTF or GLB file, node transforms applied, turned back to z up:
/// (x, y, z) becomes (x, -z, y). Vertices that were doubled at sharp edges become one again (see
/// sew_seams()). From files that loft wrote come one mesh a node, in the unit of the stack; from
/// others one mesh in metres, since there a node need not be a solid.
/// Throws FileError, and InputError that names the file. Not read: sparse, compressed or quantised
/// positions (an error says so), points and lines (left out). Bounded, as gltf_load.h says: what is
/// nested, which files are opened (those of buffers, in the same folder), what repeated meshes
/// make.
[[nodiscard]] std::vector<LabelledMesh> read_gltf(const std::filesystem::path& path);

/// The same from the file's content; files beside it are in `folder`.
[[nodiscard]] std::vector<LabelledMesh> read_gltf(std::string_view content,
                                                  const std::filesystem::path& folder,
                                                  std::string_view name);

}  // namespace loft::io
