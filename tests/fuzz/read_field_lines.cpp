// SPDX-License-Identifier: MIT
// Lines with values along them: what is read, a field takes, whatever it is.
#include <cmath>
#include <stdexcept>

#include "fields/isolines.h"
#include "io/planar/field_lines.h"
#include "mesh/admitted.h"
#include "tests/fuzz/target.h"

namespace {

using namespace loft;

void use(const io::FieldLine& line) {
  const std::size_t count = line.points.size();
  fuzz::require(count > 0, "a line without points");
  for (const cdt::Point& p : line.points)
    fuzz::require(admitted::planar.admits(p.x) && admitted::planar.admits(p.y),
                  "a coordinate that a triangulation does not take");
  const auto check = [&](const std::vector<double>& values, bool is_needed) {
    fuzz::require(values.size() == (is_needed ? count : 0), "not as many values as points");
    for (const double value : values) fuzz::require(std::isfinite(value), "a value is not finite");
  };
  check(line.values, line.kind == fields::LineKind::feature);
  check(line.left, line.kind == fields::LineKind::wall);
  check(line.right, line.kind == fields::LineKind::wall);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  const std::string text = fuzz::text_of(bytes, size);
  fuzz::try_to([&] {
    const std::vector<io::FieldLine> lines = io::read_field_lines_geojson(text, "a.geojson");
    fields::Field field;
    for (const io::FieldLine& line : lines) {
      use(line);
      try {
        (void)field.insert(line.view());
      } catch (const std::invalid_argument&) {  // it has no two different points
      }
    }
    for (const io::FieldLine& line : lines)
      for (const cdt::Point& p : line.points)
        (void)field.value(p, fields::Smoothness::cubic, fields::Side::right,
                          fields::Outside::nearest);
    const std::vector<double> levels{0, 1};
    (void)fields::isolines(field, levels);
    (void)fields::bands(field, levels);
  });
  return 0;
}
