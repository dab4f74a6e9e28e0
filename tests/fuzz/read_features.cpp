// SPDX-License-Identifier: MIT
// GeoJSON with its structure: what is read can be written, and is read back as it was.
#include <sstream>

#include "io/planar/features_geojson.h"
#include "mesh/admitted.h"
#include "tests/fuzz/target.h"

namespace {

using namespace loft;

void use(std::span<const cdt::Point> points) {
  fuzz::require(!points.empty(), "an outline without points");
  for (const cdt::Point& p : points)
    fuzz::require(admitted::planar.admits(p.x) && admitted::planar.admits(p.y),
                  "a coordinate that a triangulation does not take");
}

void use(const io::Feature& feature) {
  for (const overlay::Polygon& polygon : feature.polygons) {
    use(polygon.outer);
    for (const overlay::Ring& hole : polygon.holes) use(hole);
  }
  for (const auto& line : feature.lines) use(line);
  for (const cdt::Point& point : feature.points) use({&point, 1});
  for (const std::string& name : io::property_names(feature))
    static_cast<void>(io::property(feature, name));
}

std::string written(const io::Map& map) {
  std::ostringstream out;
  io::write_features_geojson(out, map);
  return std::move(out).str();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  const std::string text = fuzz::text_of(bytes, size);
  fuzz::try_to([&] {
    const io::Map map = io::read_features_geojson(text, "a.geojson");
    for (const io::Feature& feature : map.features) use(feature);
    const std::string again = written(map);
    const io::Map back = io::read_features_geojson(again, "a.geojson");
    fuzz::require(back == map, "another map comes back");
    fuzz::require(written(back) == again, "other bytes are written");
  });
  return 0;
}
