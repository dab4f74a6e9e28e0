// SPDX-License-Identifier: MIT
#include "io/bytes/geojson.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <utility>

#include "io/bytes/json_reader.h"
#include "io/bytes/problems.h"
#include "io/bytes/text.h"
#include "mesh/admitted.h"

namespace loft::io {

namespace {

/// Collections in collections in collections: nobody needs more of that.
constexpr int deepest_collection = 16;

/// What an object of GeoJSON has. Its values are bookmarks, read once the type is known: members
/// come in any order.
struct Members {
  std::optional<std::string> type;
  std::optional<JsonReader> features;
  std::optional<JsonReader> geometry;
  std::optional<JsonReader> geometries;
  std::optional<JsonReader> coordinates;
  std::optional<JsonReader> id;
  std::optional<JsonReader> properties;
  std::optional<JsonReader> crs;
};

/// The string that comes next; none, and left out, if it is something else.
std::optional<std::string> string_or_none(JsonReader& json) {
  if (json.peek() == JsonKind::string) return json.string();
  json.skip();
  return std::nullopt;
}

/// The text of a member of the object that comes next, the last of that key.
std::optional<std::string> find_text(JsonReader& json, std::string_view key) {
  if (json.peek() != JsonKind::object) {
    json.skip();
    return std::nullopt;
  }
  std::optional<std::string> result;
  json.begin_object();
  while (const auto found = json.next_key()) {
    if (*found == key) {
      result = string_or_none(json);
    } else {
      json.skip();
    }
  }
  return result;
}

std::optional<JsonReader> bookmark(JsonReader& json) {
  const JsonReader here = json;
  const bool is_null = json.peek() == JsonKind::null;
  json.skip();
  if (is_null) return std::nullopt;
  return here;
}

/// The name in `{"type": "name", "properties": {"name": "urn:ogc:def:crs:OGC:1.3:CRS84"}}`.
std::string read_crs(JsonReader json) {
  std::string result;
  if (json.peek() != JsonKind::object) return result;
  json.begin_object();
  while (const auto key = json.next_key()) {
    if (*key == "properties") {
      result = find_text(json, "name").value_or("");
    } else {
      json.skip();
    }
  }
  return result;
}

/// Reads the object that comes next. Precondition: it is one.
Members read_members(JsonReader& json) {
  Members members;
  json.begin_object();
  while (const auto key = json.next_key()) {
    if (*key == "type") {
      members.type = string_or_none(json);
    } else if (*key == "features") {
      members.features = bookmark(json);
    } else if (*key == "geometry") {
      members.geometry = bookmark(json);
    } else if (*key == "geometries") {
      members.geometries = bookmark(json);
    } else if (*key == "coordinates") {
      members.coordinates = bookmark(json);
    } else if (*key == "id") {
      members.id = bookmark(json);
    } else if (*key == "properties") {
      members.properties = bookmark(json);
    } else if (*key == "crs") {
      members.crs = bookmark(json);
    } else {
      json.skip();
    }
  }
  return members;
}

class GeoJsonReader {
 public:
  GeoJsonReader(std::string_view text, std::string_view name)
      : text_(without_mark(text)), name_(name) {}

  GeoJson read() {
    try {
      read_root();
    } catch (const JsonError& error) {
      problems_.add(place_of(error) + "broken JSON: " + error.what());
    }
    problems_.raise(name_);
    if (result_.shapes.empty()) {
      throw InputError(std::string(name_) + ": no point, line or polygon in it");
    }
    return std::move(result_);
  }

 private:
  /// `world.geojson:3:14: `, line and column.
  [[nodiscard]] std::string place_of(const JsonError& error) const {
    const std::string_view before = text_.substr(0, error.column() - 1);
    const auto line = 1 + std::ranges::count(before, '\n');
    const std::size_t line_begin = before.rfind('\n') + 1;  // npos + 1 is 0
    return std::string(name_) + ':' + std::to_string(line) + ':' +
           std::to_string(error.column() - line_begin) + ": ";
  }

  /// `place` ends in a blank, if there is one to name.
  void complain(const std::string& place, const std::string& problem) {
    std::string where = feature_ + place;
    if (!where.empty()) where.back() = ':';
    problems_.add(std::string(name_) + ": " + where + (where.empty() ? "" : " ") + problem);
  }

  void read_root() {
    JsonReader json(text_, "text");
    const std::string wanted = "an object of GeoJSON {\"type\": ...}";
    if (json.peek() != JsonKind::object) return complain("", reject(json, wanted));
    const Members root = read_members(json);
    json.end();
    result_.crs = root.crs;
    if (root.type == "FeatureCollection") {
      read_features(root);
    } else if (root.type == "Feature") {
      read_feature(root, "feature ");
    } else {
      result_.features.emplace_back();
      read_geometry(root, "", 0);
    }
  }

  /// Goes through the list that comes next. `read_item(i)` must take item i.
  template <class ReadItem>
  void read_list(JsonReader& json, const std::string& place, const char* wanted,
                 ReadItem read_item) {
    if (json.peek() != JsonKind::list) return complain(place, reject(json, wanted));
    json.begin_list();
    for (std::size_t i = 0; json.next_item(); ++i) read_item(i);
  }

  void read_features(const Members& root) {
    if (!root.features) return complain("", "\"features\" is missing");
    JsonReader json = *root.features;
    read_list(json, "", "a list of features", [&](std::size_t i) {
      const std::string place = "feature " + std::to_string(i) + ' ';
      if (json.peek() != JsonKind::object) return complain(place, reject(json, "a feature"));
      const Members feature = read_members(json);
      if (feature.type != "Feature") return complain(place, "its \"type\" is not \"Feature\"");
      read_feature(feature, place);
    });
  }

  void read_feature(const Members& feature, const std::string& place) {
    result_.features.push_back({place, feature.id, feature.properties});
    if (!feature.geometry) return;  // null: it has no place
    feature_ = place;
    if (const auto name = result_.features.back().text("name"))
      feature_ += '(' + in_quotes(*name) + ") ";
    JsonReader json = *feature.geometry;
    read_geometry(json, "", 0);
    feature_.clear();
  }

  void read_geometry(JsonReader& json, const std::string& place, int depth) {
    if (json.peek() != JsonKind::object) return complain(place, reject(json, "a geometry"));
    read_geometry(read_members(json), place, depth);
  }

  void read_geometry(const Members& geometry, const std::string& place, int depth) {
    if (!geometry.type) return complain(place, "\"type\" is missing");
    const std::string& type = *geometry.type;
    if (type == "GeometryCollection") return read_collection(geometry, place, depth);
    const auto known = std::ranges::find(shapes, type, &Shape::type);
    if (known == shapes.end()) return complain(place, why_unknown(type));
    if (!geometry.coordinates) return complain(place, "\"coordinates\" is missing");
    JsonReader json = *geometry.coordinates;
    (this->*known->read)(json, place);
  }

  static std::string why_unknown(const std::string& type) {
    if (type == "Topology")
      return "this is TopoJSON; convert it to GeoJSON, for example by topo2geo";
    return "the type " + in_quotes(type) + " is unknown here";
  }

  void read_collection(const Members& collection, const std::string& place, int depth) {
    if (depth == deepest_collection) return complain(place, "too many collections in one another");
    if (!collection.geometries) return complain(place, "\"geometries\" is missing");
    JsonReader json = *collection.geometries;
    read_list(json, place, "a list of geometries", [&](std::size_t i) {
      read_geometry(json, place + "geometry " + std::to_string(i) + ' ', depth + 1);
    });
  }

  // Coordinates, from lists of lists down to a point.
  void read_polygons(JsonReader& json, const std::string& place) {
    read_list(json, place, "a list of polygons", [&](std::size_t i) {
      read_rings(json, place + "polygon " + std::to_string(i) + ' ');
    });
  }

  void read_rings(JsonReader& json, const std::string& place) {
    const std::size_t before = result_.shapes.size();
    read_list(json, place, "a list of rings", [&](std::size_t i) {
      const bool is_hole = result_.shapes.size() > before;
      read_points(json, place + "ring " + std::to_string(i) + ' ', GeoKind::ring, is_hole);
    });
  }

  void read_lines(JsonReader& json, const std::string& place) {
    read_list(json, place, "a list of lines", [&](std::size_t i) {
      read_points(json, place + "line " + std::to_string(i) + ' ', GeoKind::line);
    });
  }

  void read_line(JsonReader& json, const std::string& place) {
    read_points(json, place, GeoKind::line);
  }

  void read_points(JsonReader& json, const std::string& place, GeoKind kind, bool is_hole = false) {
    GeoShape shape = begin_shape(kind);
    shape.is_hole = is_hole;
    read_list(json, place, "a list of points", [&](std::size_t i) {
      read_position(json, shape, [&] { return point_place(place, i); });
    });
    end_shape(std::move(shape));
  }

  void read_separate_points(JsonReader& json, const std::string& place) {
    read_list(json, place, "a list of points", [&](std::size_t i) {
      GeoShape shape = begin_shape(GeoKind::point);
      read_position(json, shape, [&] { return point_place(place, i); });
      end_shape(std::move(shape));
    });
  }

  void read_point(JsonReader& json, const std::string& place) {
    GeoShape shape = begin_shape(GeoKind::point);
    read_position(json, shape, [&] { return place; });
    end_shape(std::move(shape));
  }

  [[nodiscard]] GeoShape begin_shape(GeoKind kind) const {
    return {kind, {}, {}, result_.features.size() - 1};
  }
  void end_shape(GeoShape&& shape) {
    if (shape.heights.size() != shape.points.size()) shape.heights.clear();
    if (!shape.points.empty()) result_.shapes.push_back(std::move(shape));
  }

  static std::string point_place(const std::string& place, std::size_t point) {
    return place + "point " + std::to_string(point) + ' ';
  }

  /// A bad point is complained of, and stands for itself until all is read.
  /// `place` makes the text that says where.
  template <class Place>
  void read_position(JsonReader& json, GeoShape& shape, const Place& place) {
    if (json.peek() != JsonKind::list) return complain(place(), reject(json, "a point [x, y]"));
    std::array<double, 2> coordinates{};
    std::size_t count = 0;
    json.begin_list();
    for (; json.next_item(); ++count) {
      if (count < coordinates.size()) {
        coordinates[count] = read_coordinate(json, place);
      } else if (count == 2) {
        read_height(json, shape);
      } else {
        json.skip();
      }
    }
    if (count < coordinates.size()) {
      complain(place(), "has " + std::to_string(count) + " coordinates instead of [x, y]");
    }
    shape.points.push_back({coordinates[0], coordinates[1]});
  }

  /// Whoever wants heights complains of those that are none.
  static void read_height(JsonReader& json, GeoShape& shape) {
    const JsonKind kind = json.peek();
    if (kind == JsonKind::number) return shape.heights.push_back(json.number());
    json.skip();
    if (kind == JsonKind::not_finite)
      shape.heights.push_back(std::numeric_limits<double>::quiet_NaN());
  }

  template <class Place>
  double read_coordinate(JsonReader& json, const Place& place) {
    if (json.peek() != JsonKind::number) {
      complain(place(), reject(json, "a finite number"));
      return 0;
    }
    const double value = json.number();
    if (admitted::planar.admits(value)) return value;
    complain(place(), in_quotes(json.last_word()) + " is too large for a coordinate");
    return 0;
  }

  struct Shape {
    std::string_view type;
    void (GeoJsonReader::*read)(JsonReader& coordinates, const std::string& place);
  };
  static const std::array<Shape, 6> shapes;

  std::string_view text_;
  std::string_view name_;
  Problems problems_;
  std::string feature_;  // where we are: `feature 12 ('Chile') `
  GeoJson result_;
};

constexpr std::array<GeoJsonReader::Shape, 6> GeoJsonReader::shapes{{
    {"Point", &GeoJsonReader::read_point},
    {"MultiPoint", &GeoJsonReader::read_separate_points},
    {"LineString", &GeoJsonReader::read_line},
    {"MultiLineString", &GeoJsonReader::read_lines},
    {"Polygon", &GeoJsonReader::read_rings},
    {"MultiPolygon", &GeoJsonReader::read_polygons},
}};

}  // namespace

std::optional<std::string> GeoFeature::text(std::string_view key) const {
  if (!properties) return {};
  JsonReader json = *properties;
  return find_text(json, key);
}

std::optional<double> GeoFeature::number(std::string_view key) const {
  if (!properties) return {};
  JsonReader json = *properties;
  std::optional<double> result;
  if (json.peek() != JsonKind::object) return result;
  json.begin_object();
  while (const auto found = json.next_key()) {
    if (*found == key && json.peek() == JsonKind::number) {
      result = json.number();
    } else {
      json.skip();
    }
  }
  return result;
}

std::vector<std::string> GeoFeature::names() const {
  std::vector<std::string> result;
  if (!properties) return result;
  JsonReader json = *properties;
  if (json.peek() != JsonKind::object) return result;
  json.begin_object();
  while (const auto key = json.next_key()) {
    result.push_back(*key);
    json.skip();
  }
  return result;
}

std::string GeoJson::crs_name() const { return crs ? read_crs(*crs) : std::string(); }

GeoJson read_geojson(std::string_view text, std::string_view name) {
  return GeoJsonReader(text, name).read();
}

}  // namespace loft::io
