// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "io/planar/point_table.h"

namespace loft::io {

/// The points in a file, a table with a header or without, and the columns of numbers that are
/// wanted, besides all else that is in the rows (read_point_table_csv). `-` is standard input.
///
/// Throws FileError where the file cannot be read, UnknownFormat, and InputError that lists all bad
/// places (the first 20, and how many more); a file without any point is bad, too.
[[nodiscard]] PointTable read_point_table(const std::filesystem::path& path,
                                          std::span<const WantedColumn> wanted = {});

/// The extensions that read_point_table() knows, in lower case: `.csv .tsv .txt .xy .xyz`.
[[nodiscard]] std::string point_table_extensions();

}  // namespace loft::io
