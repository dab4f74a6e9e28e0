// SPDX-License-Identifier: MIT
#include "io/polylines.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <string_view>

#include "io/bytes/file.h"
#include "io/bytes/format_table.h"
#include "io/bytes/problems.h"
#include "io/bytes/text.h"
#include "io/planar/polylines_geojson.h"
#include "io/planar/polylines_text.h"

namespace loft::io {

namespace {

struct PolylineReader {
  std::string_view extension;
  std::vector<Polyline> (*read)(std::string_view content, std::string_view name);
};

constexpr std::array polyline_readers{
    PolylineReader{".geojson", read_polylines_geojson},
    PolylineReader{".json", read_polylines_geojson},
    PolylineReader{".txt", read_polylines_text},
};

std::vector<Polyline> read_piped_polylines() {
  const std::string content = read_standard_input();
  std::string_view begin = without_mark(content);
  begin.remove_prefix(std::min(begin.find_first_not_of(" \t\r\n"), begin.size()));
  const bool is_json = begin.starts_with('{');
  return is_json ? read_polylines_geojson(content, standard_input)
                 : read_polylines_text(content, standard_input);
}

}  // namespace

std::string polyline_extensions() { return extensions_of(polyline_readers); }

std::vector<Polyline> read_polylines(const std::filesystem::path& path) {
  if (path == "-") return read_piped_polylines();
  return format_of(polyline_readers, path).read(read_file(path), path.string());
}

std::vector<Polyline> read_polylines(std::span<const std::filesystem::path> paths) {
  std::vector<Polyline> polylines;
  gather_problems(paths, [&](const std::filesystem::path& path) {
    std::vector<Polyline> some = read_polylines(path);
    std::ranges::move(some, std::back_inserter(polylines));
  });
  return polylines;
}

}  // namespace loft::io
