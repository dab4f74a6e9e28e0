// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "fields/raster.h"
#include "io/planar/field_lines.h"
#include "io/planar/field_svg.h"

namespace loft::io {

/// The lines in a file, with the values along them: GeoJSON (read_field_lines_geojson). `-` is
/// standard input. Throws FileError where the file cannot be read, UnknownFormat, and InputError
/// that lists all bad places (the first 20, and how many more).
[[nodiscard]] std::vector<FieldLine> read_field_lines(const std::filesystem::path& path);

/// What is written of a field.
struct FieldOutput {
  FieldPicture picture;
  fields::Smoothness smoothness = fields::Smoothness::linear;
  std::optional<fields::Grid> grid = {};  ///< for `.asc` and `.png`; square cells
  double width = 1200;                    ///< of `.svg`, in pixels
};

/// Writes a field into one file; the extension chooses the format: the surface (`.ply`), a grid of
/// values (`.asc`), pictures (`.svg`, `.png`). The file appears whole or not at all. Throws
/// UnknownFormat, FileError and, for a grid that is not there, std::invalid_argument. Cost: that of
/// what is written; a `.png` is in memory as a whole.
void write(const std::filesystem::path& path, const FieldOutput& output);

/// Whether write() could write this file now: throws what it would throw, without touching it.
void check_writable_field(const std::filesystem::path& path);
/// Whether that format needs a grid.
[[nodiscard]] bool needs_grid(const std::filesystem::path& path);

/// The extensions that these know, in lower case: `.geojson .json`; `.asc .ply .png .svg`.
[[nodiscard]] std::string field_line_extensions();
[[nodiscard]] std::string field_output_extensions();

}  // namespace loft::io
