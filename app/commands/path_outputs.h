// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "app/json.h"
#include "io/planar/map.h"
#include "io/planar/paths_svg.h"
#include "paths/path.h"

namespace loft::app {

/// A path, and what it answers.
struct FoundPath {
  std::size_t query = 0;  ///< its number
  std::size_t edit = 0;   ///< after so many edits of the scene
  paths::Query asked;
  paths::Path path = {};
  std::size_t expansions = 0;  ///< the steps that it took
};

/// How many paths there are of each status, by its name; those that none has are left out.
[[nodiscard]] Json count_by_status(std::span<const FoundPath> paths);

/// As CSV: query, edit, status, radius, length, points (`x y;x y`), a row a path.
[[nodiscard]] std::string table_of(std::span<const FoundPath> paths);
/// A feature a path, with the properties query, edit, status, radius and length: a line where one
/// was found.
[[nodiscard]] io::Map map_of(std::span<const FoundPath> paths);
/// Adds the paths to a picture of their scene: a colour a query, those before the last edit faint.
void draw(io::PathPicture& picture, std::span<const FoundPath> paths);
/// {"query", "edit", "status", "radius", "length", "expansions"} each; length null where there is
/// none.
[[nodiscard]] Json report_of(std::span<const FoundPath> paths);

}  // namespace loft::app
