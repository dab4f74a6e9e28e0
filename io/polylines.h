// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "io/planar/polyline.h"

namespace loft::io {

/// The polylines of a file, in its order, just as they are written there. The extension chooses the
/// reader; `-` is standard input, GeoJSON if it begins with `{`, else text. All coordinates are
/// finite and at most cdt::Triangulation::largest_coordinate.
///
/// Throws FileError where the file cannot be read, UnknownFormat, and InputError that lists all bad
/// places (the first 20, and how many more); a file without any polyline is bad, too.
[[nodiscard]] std::vector<Polyline> read_polylines(const std::filesystem::path& path);

/// The polylines of several files one after the other. Problems of all of them are listed.
[[nodiscard]] std::vector<Polyline> read_polylines(std::span<const std::filesystem::path> paths);

/// The extensions that read_polylines() knows, in lower case: `.geojson .json .txt`.
[[nodiscard]] std::string polyline_extensions();

}  // namespace loft::io
