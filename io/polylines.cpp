// SPDX-License-Identifier: MIT
#include "io/polylines.h"

#include <algorithm>
#include <array>
#include <iostream>
#include <iterator>
#include <string_view>

#include "io/bytes/file.h"
#include "io/bytes/format_table.h"
#include "io/bytes/text.h"
#include "io/planar/polylines_geojson.h"
#include "io/planar/polylines_text.h"
#include "reconstruct/defect.h"

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

std::vector<Polyline> read_standard_input() {
  const std::string name = "standard input";
  const std::string content{std::istreambuf_iterator<char>(std::cin), {}};
  if (std::cin.bad()) throw FileError(Access::read, name, last_cause());
  std::string_view begin = without_mark(content);
  begin.remove_prefix(std::min(begin.find_first_not_of(" \t\r\n"), begin.size()));
  const bool is_json = begin.starts_with('{');
  return is_json ? read_polylines_geojson(content, name) : read_polylines_text(content, name);
}

}  // namespace

std::string polyline_extensions() { return extensions_of(polyline_readers); }

std::vector<Polyline> read_polylines(const std::filesystem::path& path) {
  if (path == "-") return read_standard_input();
  return format_of(polyline_readers, path).read(read_file(path), path.string());
}

std::vector<Polyline> read_polylines(std::span<const std::filesystem::path> paths) {
  std::vector<Polyline> polylines;
  std::string problems;
  for (const std::filesystem::path& path : paths) {
    try {
      std::vector<Polyline> some = read_polylines(path);
      std::ranges::move(some, std::back_inserter(polylines));
    } catch (const InputError& error) {
      if (!problems.empty()) problems += '\n';
      problems += error.what();
    }
  }
  if (!problems.empty()) throw InputError(problems);
  return polylines;
}

}  // namespace loft::io
