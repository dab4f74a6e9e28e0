// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <ostream>
#include <span>
#include <string>
#include <string_view>

#include "io/meshes/part.h"
#include "io/rounding/rounding.h"

namespace loft::io {

/// What became of surfaces in a file.
struct Written {
  Rounding rounding;             ///< of formats with `float` coordinates
  std::optional<Vec3> origin{};  ///< of an STL that is not about 0: what to add to its coordinates
};

/// Writes surfaces into one file; the extension chooses the format. The same surfaces and options
/// give the same bytes. The file appears whole or not at all.
///
/// Where coordinates are `float` (.stl, .glb, .gltf; of 16 bits in compressed glTF) the rounded
/// surfaces are tested exactly, and mended by neighbouring floats (io/rounding); what could not be
/// mended is counted. In an STL, which has no vertices, parts that touch are drawn apart by as
/// much; one whose coordinates are too far from 0 for `float` is about a round place near it,
/// unless the options name another one.
///
/// An OBJ whose parts have labels or colours has its materials in a second file beside it
/// (materials.h), which replaces one of that name and is there first.
///
/// Throws UnknownFormat, FileError, and Error where the format cannot hold the surfaces.
/// Cost: O(n log n), O(n) for other formats, with the file in memory.
Written write(const std::filesystem::path& path, std::span<const Part> parts,
              const WriteOptions& options = {});

/// The same into a stream, in the format of that extension, for example `.ply`.
Written write(std::ostream& out, std::string_view extension, std::span<const Part> parts,
              const WriteOptions& options = {});

/// Whether write() could write this file now: throws what it would throw, without touching it.
void check_writable(const std::filesystem::path& path);

/// The extensions that write() knows, in lower case: `.glb .gltf .ply ...`.
[[nodiscard]] std::string surface_extensions();

}  // namespace loft::io
