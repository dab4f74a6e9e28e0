// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "io/planar/map.h"
#include "io/planar/svg.h"

namespace loft::io {

/// The map in a file: GeoJSON. `-` is standard input. All coordinates are such that an overlay
/// takes them.
///
/// Throws FileError where the file cannot be read, UnknownFormat, and InputError that lists all bad
/// places (the first 20, and how many more); a map with nothing on it is bad, too.
[[nodiscard]] Map read_map(const std::filesystem::path& path);

/// The maps of several files. Problems of all of them are listed.
[[nodiscard]] std::vector<Map> read_maps(std::span<const std::filesystem::path> paths);

/// Writes a map into one file; the extension chooses the format. The same map and options give the
/// same bytes. The file appears whole or not at all.
///
/// Throws UnknownFormat and FileError. Cost: O(n), for pictures O(n log n).
void write(const std::filesystem::path& path, const Map& map, const SvgOptions& options = {});

/// Whether write() could write this file now: throws what it would throw, without touching it.
void check_writable_map(const std::filesystem::path& path);

/// The extensions that read_map() and write() know, in lower case: `.geojson .json`, and `.svg` to
/// write.
[[nodiscard]] std::string map_extensions();
[[nodiscard]] std::string map_output_extensions();

}  // namespace loft::io
