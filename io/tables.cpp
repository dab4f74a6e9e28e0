// SPDX-License-Identifier: MIT
#include "io/tables.h"

#include <array>
#include <string_view>

#include "io/bytes/file.h"
#include "io/bytes/format_table.h"

namespace loft::io {

namespace {

struct PointTableFormat {
  std::string_view extension;
};

constexpr std::array point_table_formats{
    PointTableFormat{".csv"}, PointTableFormat{".tsv"}, PointTableFormat{".txt"},
    PointTableFormat{".xy"},  PointTableFormat{".xyz"},
};

}  // namespace

std::string point_table_extensions() { return extensions_of(point_table_formats); }

PointTable read_point_table(const std::filesystem::path& path,
                            std::span<const WantedColumn> wanted) {
  if (path == "-") return read_point_table_csv(read_standard_input(), standard_input, wanted);
  static_cast<void>(format_of(point_table_formats, path));
  return read_point_table_csv(read_file(path), path.string(), wanted);
}

}  // namespace loft::io
