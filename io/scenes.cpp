// SPDX-License-Identifier: MIT
#include "io/scenes.h"

#include <array>
#include <string_view>

#include "io/bytes/atomic_file.h"
#include "io/bytes/file.h"
#include "io/bytes/format_table.h"
#include "io/planar/features_geojson.h"
#include "io/planar/moving_ai.h"

namespace loft::io {

namespace {

struct SceneFormat {
  std::string_view extension;
  Map (*read)(std::string_view content, std::string_view name);
  Upwards upwards = Upwards::y;
};

constexpr std::array scene_formats{
    SceneFormat{".geojson", read_features_geojson},
    SceneFormat{".json", read_features_geojson},
    SceneFormat{".map", read_moving_ai_map, Upwards::minus_y},
};

struct PathQueryFormat {
  std::string_view extension;
  std::vector<PathQuery> (*read)(std::string_view content, std::string_view name);
};

constexpr std::array path_query_formats{
    PathQueryFormat{".csv", read_path_queries_csv},
    PathQueryFormat{".tsv", read_path_queries_csv},
    PathQueryFormat{".txt", read_path_queries_csv},
    PathQueryFormat{".xy", read_path_queries_csv},
    PathQueryFormat{".scen", read_moving_ai_scenario},
};

struct SceneEditFormat {
  std::string_view extension;
};

constexpr std::array scene_edit_formats{
    SceneEditFormat{".ndjson"},
    SceneEditFormat{".jsonl"},
};

}  // namespace

std::string scene_extensions() { return extensions_of(scene_formats); }
std::string path_query_extensions() { return extensions_of(path_query_formats); }
std::string scene_edit_extensions() { return extensions_of(scene_edit_formats); }

Scene read_scene(const std::filesystem::path& path) {
  if (path == "-") return {read_features_geojson(read_standard_input(), standard_input)};
  const SceneFormat& format = format_of(scene_formats, path);
  return {format.read(read_file(path), path.string()), format.upwards};
}

std::vector<PathQuery> read_path_queries(const std::filesystem::path& path) {
  if (path == "-") return read_path_queries_csv(read_standard_input(), standard_input);
  return format_of(path_query_formats, path).read(read_file(path), path.string());
}

std::vector<SceneEdit> read_scene_edits(const std::filesystem::path& path) {
  if (path == "-") return read_scene_edits(read_standard_input(), standard_input);
  static_cast<void>(format_of(scene_edit_formats, path));
  return read_scene_edits(read_file(path), path.string());
}

void write(const std::filesystem::path& path, const PathPicture& picture, double width) {
  AtomicFile file(path);
  write_paths_svg(file.stream(), picture, width);
  file.commit();
}

}  // namespace loft::io
