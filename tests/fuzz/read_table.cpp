// SPDX-License-Identifier: MIT
// Tables of points with values; what is read of them can be used.
#include <array>
#include <cmath>

#include "io/planar/point_table.h"
#include "mesh/admitted.h"
#include "tests/fuzz/target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace loft;
  const std::string text = fuzz::text_of(bytes, size);
  fuzz::try_to([&] {
    const std::array wanted{io::WantedColumn{{"z", "value"}}, io::WantedColumn{{"weight"}, false}};
    const io::PointTable table = io::read_point_table_csv(text, "a.csv", wanted);
    fuzz::require(!table.points().empty(), "a table without points");
    for (std::size_t row = 0; row < table.points().size(); ++row) {
      const cdt::Point& p = table.points()[row];
      fuzz::require(admitted::planar.admits(p.x) && admitted::planar.admits(p.y),
                    "a coordinate that a triangulation does not take");
      fuzz::require(!table.cell(row, table.x_column()).empty(), "a coordinate without its cell");
    }
    fuzz::require(table.values()[0].has_value(), "a column that is needed is not there");
    for (const auto& column : table.values()) {
      if (!column) continue;
      fuzz::require(column->values.size() == table.points().size(), "a value too many, or few");
      for (const double value : column->values)
        fuzz::require(std::isfinite(value), "a value that is not finite");
    }
  });
  return 0;
}
