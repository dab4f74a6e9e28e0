// SPDX-License-Identifier: MIT
#include "io/planar/features_geojson.h"

#include <optional>
#include <span>
#include <string>
#include <utility>

#include "io/bytes/geojson.h"
#include "io/bytes/json_reader.h"
#include "reconstruct/number_text.h"

namespace loft::io {

namespace {

/// Empty where there is none, as where it is null, or a number that is not finite.
std::string text_of_member(std::optional<JsonReader> member) {
  std::string text = member ? compact_json(member->text()) : std::string();
  return text == "null" ? std::string() : text;
}

void add_shape(Feature& feature, GeoShape& shape) {
  std::vector<cdt::Point>& points = shape.points;
  if (shape.kind == GeoKind::point) {
    feature.points.push_back(points.front());
  } else if (shape.kind == GeoKind::line) {
    feature.lines.push_back(std::move(points));
  } else {
    if (points.size() > 1 && points.front() == points.back()) points.pop_back();
    if (shape.is_hole) {
      feature.polygons.back().holes.push_back(std::move(points));
    } else {
      feature.polygons.push_back({.outer = std::move(points), .holes = {}});
    }
  }
}

/// The text of a feature's geometry, from points up to collections.
class GeometryText {
 public:
  explicit GeometryText(std::string& text) : text_(text) {}

  void append(const Feature& feature) {
    const int kinds = !feature.polygons.empty() + !feature.lines.empty() + !feature.points.empty();
    if (kinds == 0) text_ += "null";
    if (kinds > 1) text_ += R"({"type":"GeometryCollection","geometries":[)";
    const char* between = "";
    const auto append_kind = [&](const char* type, const auto& items, auto append_item) {
      if (items.empty()) return;
      text_ += std::exchange(between, ",");
      append_items(type, items, append_item);
    };
    append_kind("Polygon", feature.polygons, [&](const auto& one) { append_polygon(one); });
    append_kind("LineString", feature.lines, [&](const auto& line) {
      append_list(line, [&](cdt::Point p) { append_point(p); });
    });
    append_kind("Point", feature.points, [&](cdt::Point p) { append_point(p); });
    if (kinds > 1) text_ += "]}";
  }

 private:
  /// A geometry of that type, or of many of them.
  template <class Item, class AppendItem>
  void append_items(const char* type, const std::vector<Item>& items, AppendItem append_item) {
    text_ += items.size() > 1 ? R"({"type":"Multi)" : R"({"type":")";
    text_ += type;
    text_ += R"(","coordinates":)";
    if (items.size() > 1) {
      append_list(items, append_item);
    } else {
      append_item(items.front());
    }
    text_ += '}';
  }

  template <class Item, class AppendItem>
  void append_list(const std::vector<Item>& items, AppendItem append_item) {
    text_ += '[';
    for (const Item& item : items) {
      if (&item != items.data()) text_ += ',';
      append_item(item);
    }
    text_ += ']';
  }

  void append_polygon(const overlay::Polygon& polygon) {
    text_ += '[';
    append_ring(polygon.outer);
    for (const overlay::Ring& hole : polygon.holes) {
      text_ += ',';
      append_ring(hole);
    }
    text_ += ']';
  }

  void append_ring(const overlay::Ring& ring) {
    append_list(ring, [&](cdt::Point p) { append_point(p); });
    text_.back() = ',';
    append_point(ring.front());
    text_ += ']';
  }

  void append_point(cdt::Point point) {
    text_ += '[';
    append_number(text_, point.x);
    text_ += ',';
    append_number(text_, point.y);
    text_ += ']';
  }

  std::string& text_;
};

std::string text_of(const Feature& feature) {
  std::string text = R"({"type":"Feature")";
  if (!feature.id.empty()) text += ",\"id\":" + feature.id;
  text += ",\"properties\":" + (feature.properties.empty() ? "null" : feature.properties);
  text += ",\"geometry\":";
  GeometryText(text).append(feature);
  return text += '}';
}

}  // namespace

Map read_features_geojson(std::string_view text, std::string_view name) {
  GeoJson json = read_geojson(text, name);
  Map map{.features = {}, .crs = text_of_member(json.crs)};
  map.features.reserve(json.features.size());
  for (const GeoFeature& feature : json.features)
    map.features.push_back(
        {.id = text_of_member(feature.id), .properties = text_of_member(feature.properties)});
  for (GeoShape& shape : json.shapes) add_shape(map.features[shape.feature], shape);
  return map;
}

void write_features_geojson(std::ostream& out, const Map& map) {
  out << R"({"type":"FeatureCollection",)";
  if (!map.crs.empty()) out << "\"crs\":" << map.crs << ',';
  out << "\"features\":[";
  const char* between = "\n";
  for (const Feature& feature : map.features)
    out << std::exchange(between, ",\n") << text_of(feature);
  out << "\n]}\n";
}

}  // namespace loft::io
