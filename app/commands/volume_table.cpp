// SPDX-License-Identifier: MIT
#include "app/commands/volume_table.h"

#include "app/commands/label_volumes.h"
#include "app/report.h"
#include "app/table.h"
#include "io/bytes/atomic_file.h"
#include "io/bytes/csv_field.h"
#include "reconstruct/number_text.h"

namespace loft::app {

std::vector<std::string> volume_table(std::span<const PartReport> parts, const std::string& unit) {
  std::vector<std::vector<std::string>> rows{
      {"label", "slices", "contours", "volume cm^3", "area " + unit + "^2"}};
  for (const PartReport& part : parts)
    rows.push_back({part.label, grouped(part.input.slices), grouped(part.input.contours),
                    rounded(cubic_centimetres(part.measures.volume, unit)),
                    rounded(part.measures.area)});
  return aligned(rows);
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
