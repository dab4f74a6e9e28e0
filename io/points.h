// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cdt/point.h"

namespace loft::io {

/// The points in a file, in its order: a table with a header or without. `-` is standard input. All
/// coordinates are such that a triangulation takes them.
///
/// Throws FileError where the file cannot be read, UnknownFormat, and InputError that lists all bad
/// lines (the first 20, and how many more); a file without any point is bad, too.
[[nodiscard]] std::vector<cdt::Point> read_points(const std::filesystem::path& path);

/// The extensions that read_points() knows, in lower case: `.csv .tsv .txt .xy`.
[[nodiscard]] std::string points_extensions();

}  // namespace loft::io
