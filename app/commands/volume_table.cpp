// SPDX-License-Identifier: MIT
#include "app/commands/volume_table.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "app/commands/label_volumes.h"
#include "app/report.h"
#include "io/bytes/atomic_file.h"
#include "io/bytes/csv_field.h"
#include "reconstruct/number_text.h"

namespace loft::app {

namespace {

using Row = std::array<std::string, 5>;

/// How many characters UTF-8 shows.
std::size_t width(const std::string& text) {
  return static_cast<std::size_t>(std::ranges::count_if(
      text, [](char c) { return (static_cast<unsigned char>(c) & 0xc0U) != 0x80U; }));
}

}  // namespace

std::vector<std::string> volume_table(std::span<const PartReport> parts, const std::string& unit) {
  std::vector<Row> rows{{"label", "slices", "contours", "volume cm^3", "area " + unit + "^2"}};
  for (const PartReport& part : parts)
    rows.push_back({part.label, grouped(part.input.slices), grouped(part.input.contours),
                    rounded(cubic_centimetres(part.measures.volume, unit)),
                    rounded(part.measures.area)});
  std::array<std::size_t, 5> widths{};
  for (const Row& row : rows)
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], width(row[i]));
  std::vector<std::string> lines;
  for (const Row& row : rows) {
    std::string line;
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string padding(widths[i] - width(row[i]), ' ');
      line += (i == 0 ? "" : "  ") + (i == 0 ? row[i] + padding : padding + row[i]);
    }
    lines.push_back(std::move(line));
  }
  return lines;
}

void write_volumes_csv(const std::filesystem::path& path, std::span<const PartReport> parts,
                       const std::string& unit) {
  std::string text = "label,slices,contours,volume_cm3,volume,unit,area\r\n";
  for (const PartReport& part : parts) {
    text += io::csv_field(part.label) + ',' + std::to_string(part.input.slices) + ',' +
            std::to_string(part.input.contours) + ',';
    append_number(text, cubic_centimetres(part.measures.volume, unit));
    text += ',';
    append_number(text, part.measures.volume);
    text += ',' + io::csv_field(unit) + ',';
    append_number(text, part.measures.area);
    text += "\r\n";
  }
  io::AtomicFile file(path);
  file.stream() << text;
  file.commit();
}

}  // namespace loft::app
