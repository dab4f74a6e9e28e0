// SPDX-License-Identifier: MIT
// GeoJSON, text, tables of points; what is read of both fits into a triangulation.
#include <sstream>

#include "io/planar/points_csv.h"
#include "io/planar/polylines_geojson.h"
#include "io/planar/polylines_text.h"
#include "mesh/admitted.h"
#include "tests/fuzz/target.h"

namespace {

using namespace loft;

void use(const std::vector<cdt::Point>& points) {
  fuzz::require(!points.empty(), "a polyline without points");
  for (const cdt::Point& p : points)
    fuzz::require(admitted::planar.admits(p.x) && admitted::planar.admits(p.y),
                  "a coordinate that a triangulation does not take");
}

void use(const std::vector<io::Polyline>& polylines) {
  for (const io::Polyline& polyline : polylines) use(polyline.points);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  const std::string text = fuzz::text_of(bytes, size);
  fuzz::try_to([&] { use(io::read_polylines_geojson(text, "a.geojson")); });
  fuzz::try_to([&] { use(io::read_points_csv(text, "a.csv")); });
  fuzz::try_to([&] {
    const auto polylines = io::read_polylines_text(text, "a.txt");
    use(polylines);
    std::ostringstream again;
    io::write_polylines_text(again, polylines);
    const auto back = io::read_polylines_text(again.str(), "a.txt");
    fuzz::require(back.size() == polylines.size(), "other polylines come back");
    for (std::size_t i = 0; i < back.size(); ++i)
      fuzz::require(back[i].points == polylines[i].points && back[i].ends == polylines[i].ends,
                    "another polyline comes back");
  });
  return 0;
}
