// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "io/planar/planar_mesh.h"
#include "io/planar/svg.h"

namespace loft::io {

/// Writes a triangulation into one file; the extension chooses the format. The same mesh and
/// options give the same bytes. The file appears whole or not at all.
///
/// Throws UnknownFormat and FileError. Cost: O(n log n), with the file in memory.
void write(const std::filesystem::path& path, const PlanarMesh& mesh,
           const SvgOptions& options = {});

/// Whether write() could write this file now: throws what it would throw, without touching it.
void check_writable_triangulation(const std::filesystem::path& path);

/// The extensions that write() knows for triangulations, in lower case: `.svg .ply .json`.
[[nodiscard]] std::string triangulation_extensions();

}  // namespace loft::io
