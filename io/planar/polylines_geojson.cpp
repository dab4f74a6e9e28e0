// SPDX-License-Identifier: MIT
#include "io/planar/polylines_geojson.h"

#include <string>
#include <utility>

#include "io/bytes/geojson.h"

namespace loft::io {

std::vector<Polyline> read_polylines_geojson(std::string_view text, std::string_view name) {
  GeoJson json = read_geojson(text, name);
  std::vector<std::string> names;
  names.reserve(json.features.size());
  for (const GeoFeature& feature : json.features)
    names.push_back(feature.text("name").value_or(""));
  std::vector<Polyline> polylines;
  polylines.reserve(json.shapes.size());
  for (GeoShape& shape : json.shapes) {
    std::vector<cdt::Point>& points = shape.points;
    const bool is_ring = shape.kind == GeoKind::ring;
    if (is_ring && points.size() > 1 && points.front() == points.back()) points.pop_back();
    polylines.push_back(
        {std::move(points), is_ring ? cdt::closed : cdt::open, names[shape.feature]});
  }
  return polylines;
}

}  // namespace loft::io
