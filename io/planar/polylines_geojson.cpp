// SPDX-License-Identifier: MIT
#include "io/planar/polylines_geojson.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>

#include "io/bytes/json_reader.h"
#include "io/bytes/problems.h"
#include "io/bytes/text.h"
#include "io/planar/coordinate.h"

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
  std::optional<std::string> name;  ///< of its properties
};

/// The string that comes next; none, and left out, if it is something else.
std::optional<std::string> string_or_none(JsonReader& json) {
  if (json.peek() == JsonKind::string) return json.string();
  json.skip();
  return std::nullopt;
}

std::optional<JsonReader> bookmark(JsonReader& json) {
  const JsonReader here = json;
  const bool is_null = json.peek() == JsonKind::null;
  json.skip();
  if (is_null) return std::nullopt;
  return here;
}

std::optional<std::string> read_name(JsonReader& properties) {
  if (properties.peek() != JsonKind::object) {
    properties.skip();
    return std::nullopt;
  }
  std::optional<std::string> name;
  properties.begin_object();
  while (const auto key = properties.next_key()) {
    if (*key == "name") {
      name = string_or_none(properties);
    } else {
      properties.skip();
    }
  }
  return name;
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
    } else if (*key == "properties") {
      members.name = read_name(json);
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

  std::vector<Polyline> read() {
    try {
      read_root();
    } catch (const JsonError& error) {
      problems_.add(place_of(error) + "broken JSON: " + error.what());
    }
    problems_.raise(name_);
    if (polylines_.empty()) {
      throw InputError(std::string(name_) + ": no point, line or polygon in it");
    }
    return std::move(polylines_);
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
    if (root.type == "FeatureCollection") {
      read_features(root);
    } else if (root.type == "Feature") {
      read_feature(root, "feature ");
    } else {
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
    if (!feature.geometry) return;  // null: it has no place
    feature_ = place;
    if (feature.name) feature_ += '(' + in_quotes(*feature.name) + ") ";
    feature_name_ = feature.name.value_or("");
    JsonReader json = *feature.geometry;
    read_geometry(json, "", 0);
    feature_.clear();
    feature_name_.clear();
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
    read_list(json, place, "a list of rings", [&](std::size_t i) {
      read_points(json, place + "ring " + std::to_string(i) + ' ', cdt::closed);
    });
  }

  void read_lines(JsonReader& json, const std::string& place) {
    read_list(json, place, "a list of lines", [&](std::size_t i) {
      read_points(json, place + "line " + std::to_string(i) + ' ', cdt::open);
    });
  }

  void read_line(JsonReader& json, const std::string& place) {
    read_points(json, place, cdt::open);
  }

  void read_points(JsonReader& json, const std::string& place, cdt::Ends ends) {
    Polyline polyline{{}, ends, feature_name_};
    read_list(json, place, "a list of points", [&](std::size_t i) {
      polyline.points.push_back(read_position(json, [&] { return point_place(place, i); }));
    });
    std::vector<cdt::Point>& points = polyline.points;
    if (ends == cdt::closed && points.size() > 1 && points.front() == points.back()) {
      points.pop_back();
    }
    if (!points.empty()) polylines_.push_back(std::move(polyline));
  }

  void read_separate_points(JsonReader& json, const std::string& place) {
    read_list(json, place, "a list of points", [&](std::size_t i) {
      const cdt::Point point = read_position(json, [&] { return point_place(place, i); });
      polylines_.push_back({{point}, cdt::open, feature_name_});
    });
  }

  void read_point(JsonReader& json, const std::string& place) {
    const cdt::Point point = read_position(json, [&] { return place; });
    polylines_.push_back({{point}, cdt::open, feature_name_});
  }

  static std::string point_place(const std::string& place, std::size_t point) {
    return place + "point " + std::to_string(point) + ' ';
  }

  /// A bad point is complained of, and stands for itself until all is read.
  /// `place` makes the text that says where.
  template <class Place>
  cdt::Point read_position(JsonReader& json, const Place& place) {
    if (json.peek() != JsonKind::list) {
      complain(place(), reject(json, "a point [x, y]"));
      return {};
    }
    std::array<double, 2> coordinates{};
    std::size_t count = 0;
    json.begin_list();
    for (; json.next_item(); ++count) {
      if (count < coordinates.size()) {
        coordinates[count] = read_coordinate(json, place);
      } else {
        json.skip();
      }
    }
    if (count < coordinates.size()) {
      complain(place(), "has " + std::to_string(count) + " coordinates instead of [x, y]");
    }
    return {coordinates[0], coordinates[1]};
  }

  template <class Place>
  double read_coordinate(JsonReader& json, const Place& place) {
    if (json.peek() != JsonKind::number) {
      complain(place(), reject(json, "a finite number"));
      return 0;
    }
    const double value = json.number();
    if (is_coordinate(value)) return value;
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
  std::string feature_name_;
  std::vector<Polyline> polylines_;
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

std::vector<Polyline> read_polylines_geojson(std::string_view text, std::string_view name) {
  return GeoJsonReader(text, name).read();
}

}  // namespace loft::io
