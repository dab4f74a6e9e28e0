// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/planar/map.h"
#include "io/planar/path_queries.h"
#include "io/planar/paths_svg.h"
#include "io/planar/scene_edits.h"

namespace loft::io {

/// Where ways are looked for: what is free and what is in the way.
struct Scene {
  Map map;
  Upwards upwards = Upwards::y;  ///< in a picture

  friend bool operator==(const Scene&, const Scene&) = default;
};

/// The scene, the queries, the edits in a file; the extension chooses the format, `-` is standard
/// input: GeoJSON, a table, NDJSON. All coordinates are such that an overlay takes them.
///
/// Each throws FileError where the file cannot be read, UnknownFormat, and InputError that lists
/// all bad places (the first 20, and how many more); a file with nothing in it is bad, too.
[[nodiscard]] Scene read_scene(const std::filesystem::path& path);
[[nodiscard]] std::vector<PathQuery> read_path_queries(const std::filesystem::path& path);
[[nodiscard]] std::vector<SceneEdit> read_scene_edits(const std::filesystem::path& path);

/// Draws ways into one file, .svg. It appears whole or not at all. Throws FileError.
void write(const std::filesystem::path& path, const PathPicture& picture, double width = 1200);

/// The extensions that are known, in lower case: `.geojson .json .map`;
/// `.csv .tsv .txt .xy .scen`; `.ndjson .jsonl`.
[[nodiscard]] std::string scene_extensions();
[[nodiscard]] std::string path_query_extensions();
[[nodiscard]] std::string scene_edit_extensions();

}  // namespace loft::io
