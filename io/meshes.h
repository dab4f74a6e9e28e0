// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/meshes/labelled_mesh.h"
#include "reconstruct/slice.h"

namespace loft::io {

/// The meshes in a file; the extension chooses the reader. `precomputed://FOLDER` is a folder of
/// Neuroglancer's (precomputed.h), in nanometres. One mesh a label where loft wrote the
/// file and the format keeps labels (PLY, OBJ, glTF), else one. Every mesh has faces, and their
/// indices are valid; nothing else is promised. Files from STL and glTF have their seams closed.
/// Colours are those of PLY (of vertices) and glTF (of materials).
/// glTF comes back with z up, in the stack's unit where loft wrote it, in metres elsewhere.
///
/// Throws FileError, UnknownFormat, and InputError that names file and place. Sizes in the file are
/// not trusted. Cost: O(n), O(n log n) where seams are closed.
[[nodiscard]] std::vector<LabelledMesh> read_meshes(const std::filesystem::path& path);

/// The same as one mesh.
[[nodiscard]] Mesh read_mesh(const std::filesystem::path& path);

/// The contours that the surface in a file was made of, as far as it knows them (PLY, and glTF with
/// contours): slices from low to high. Empty for what knows none. Throws as read_meshes().
[[nodiscard]] std::vector<Slice> read_contours(const std::filesystem::path& path);

/// The extensions that read_meshes() knows, in lower case: `.ply .obj ...`.
[[nodiscard]] std::string mesh_extensions();

/// Whether read_meshes() has a reader for this file, going by its name alone.
[[nodiscard]] bool is_mesh_file(const std::filesystem::path& path);

/// Whether the file's format has `double` or decimal coordinates, so that they come back exactly.
[[nodiscard]] bool keeps_coordinates(const std::filesystem::path& path);

}  // namespace loft::io
