// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <ostream>
#include <span>
#include <string>
#include <string_view>

#include "io/meshes/part.h"

namespace loft::io {

/// Writes surfaces into one file; the extension chooses the format. The same surfaces and options
/// give the same bytes. The file appears whole or not at all.
///
/// Throws UnknownFormat, FileError, and Error where the format cannot hold the surfaces.
/// Cost: O(n), with the file in memory.
void write(const std::filesystem::path& path, std::span<const Part> parts,
           const WriteOptions& options = {});

/// The same into a stream, in the format of that extension, for example `.ply`.
void write(std::ostream& out, std::string_view extension, std::span<const Part> parts,
           const WriteOptions& options = {});

/// Whether write() could write this file now: throws what it would throw, without touching it.
void check_writable(const std::filesystem::path& path);

/// The extensions that write() knows, in lower case: `.glb .gltf .ply ...`.
[[nodiscard]] std::string surface_extensions();

}  // namespace loft::io
