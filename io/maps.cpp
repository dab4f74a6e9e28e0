// SPDX-License-Identifier: MIT
#include "io/maps.h"

#include <array>
#include <ostream>
#include <string_view>

#include "io/bytes/atomic_file.h"
#include "io/bytes/file.h"
#include "io/bytes/format_table.h"
#include "io/bytes/problems.h"
#include "io/planar/features_geojson.h"
#include "io/planar/map_svg.h"

namespace loft::io {

namespace {

struct MapReader {
  std::string_view extension;
  Map (*read)(std::string_view content, std::string_view name);
};

constexpr std::array map_readers{
    MapReader{".geojson", read_features_geojson},
    MapReader{".json", read_features_geojson},
};

struct MapWriter {
  std::string_view extension;
  void (*write)(std::ostream&, const Map&, const SvgOptions&);
};

void write_features(std::ostream& out, const Map& map, const SvgOptions&) {
  write_features_geojson(out, map);
}

constexpr std::array map_writers{
    MapWriter{".geojson", write_features},
    MapWriter{".json", write_features},
    MapWriter{".svg", write_map_svg},
};

}  // namespace

std::string map_extensions() { return extensions_of(map_readers); }
std::string map_output_extensions() { return extensions_of(map_writers); }

Map read_map(const std::filesystem::path& path) {
  if (path == "-") return read_features_geojson(read_standard_input(), standard_input);
  return format_of(map_readers, path).read(read_file(path), path.string());
}

std::vector<Map> read_maps(std::span<const std::filesystem::path> paths) {
  std::vector<Map> maps;
  gather_problems(paths, [&](const auto& path) { maps.push_back(read_map(path)); });
  return maps;
}

void check_writable_map(const std::filesystem::path& path) {
  static_cast<void>(format_of(map_writers, path));
  const AtomicFile tried(path);
}

void write(const std::filesystem::path& path, const Map& map, const SvgOptions& options) {
  const MapWriter& format = format_of(map_writers, path);
  AtomicFile file(path);
  format.write(file.stream(), map, options);
  file.commit();
}

}  // namespace loft::io
