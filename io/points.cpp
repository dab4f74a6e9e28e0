// SPDX-License-Identifier: MIT
#include "io/points.h"

#include <array>
#include <string_view>

#include "io/bytes/file.h"
#include "io/bytes/format_table.h"
#include "io/planar/points_csv.h"

namespace loft::io {

namespace {

struct PointsFormat {
  std::string_view extension;
  std::vector<cdt::Point> (*read)(std::string_view content, std::string_view name);
};

constexpr std::array points_formats{
    PointsFormat{".csv", read_points_csv},
    PointsFormat{".tsv", read_points_csv},
    PointsFormat{".txt", read_points_csv},
    PointsFormat{".xy", read_points_csv},
};

}  // namespace

std::string points_extensions() { return extensions_of(points_formats); }

std::vector<cdt::Point> read_points(const std::filesystem::path& path) {
  if (path == "-") return read_points_csv(read_standard_input(), standard_input);
  return format_of(points_formats, path).read(read_file(path), path.string());
}

}  // namespace loft::io
