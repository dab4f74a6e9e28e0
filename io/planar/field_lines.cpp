// SPDX-License-Identifier: MIT
#include "io/planar/field_lines.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "io/bytes/geojson.h"
#include "io/bytes/json_reader.h"
#include "io/bytes/problems.h"
#include "io/bytes/text.h"
#include "reconstruct/defect.h"

namespace loft::io {

namespace {

using fields::LineKind;

/// One number for all, or one for each.
struct GivenValues {
  bool is_there = false;
  bool is_list = false;
  std::vector<double> numbers = {};
};

/// What a feature's properties say of the values along it.
struct LineProperties {
  std::optional<std::string> kind;
  GivenValues values;
  GivenValues left;
  GivenValues right;
};

class FieldLineReader {
 public:
  FieldLineReader(std::string_view text, std::string_view name)
      : name_(name), json_(read_geojson(text, name)) {}

  std::vector<FieldLine> read() {
    std::vector<LineProperties> all;
    for (const GeoFeature& feature : json_.features) all.push_back(properties_of(feature));
    for (GeoShape& shape : json_.shapes)
      if (shape.kind != GeoKind::point) add(shape, all[shape.feature]);
    problems_.raise(name_);
    return std::move(lines_);
  }

 private:
  void complain(const std::string& place, const std::string& what) {
    problems_.add(std::string(name_) + ": " + place + what);
  }

  LineProperties properties_of(const GeoFeature& feature) {
    LineProperties result;
    if (!feature.properties) return result;
    JsonReader json = *feature.properties;
    if (json.peek() != JsonKind::object) return result;
    json.begin_object();
    while (const auto key = json.next_key()) {
      if (*key == "kind")
        result.kind = kind_text(json, feature.place);
      else if (*key == "values")
        result.values = numbers(json, feature.place, "values");
      else if (*key == "left")
        result.left = numbers(json, feature.place, "left");
      else if (*key == "right")
        result.right = numbers(json, feature.place, "right");
      else
        json.skip();
    }
    return result;
  }

  std::optional<std::string> kind_text(JsonReader& json, const std::string& place) {
    if (json.peek() == JsonKind::string) return json.string();
    if (json.peek() != JsonKind::null)
      complain(place, "kind: " + reject(json, "a text"));
    else
      json.skip();
    return {};
  }

  GivenValues numbers(JsonReader& json, const std::string& place, const std::string& key) {
    GivenValues given;
    const auto take = [&] {
      if (json.peek() != JsonKind::number) {
        complain(place, key + ": " + reject(json, "a number"));
        given.numbers.push_back(0);
        return;
      }
      given.numbers.push_back(json.number());
      if (!fields::Field::is_usable(given.numbers.back()))
        complain(place, key + ": a number beyond 1e150");
    };
    if (json.peek() == JsonKind::null) {
      json.skip();
      return given;
    }
    given.is_there = true;
    given.is_list = json.peek() == JsonKind::list;
    if (!given.is_list) {
      take();
      return given;
    }
    json.begin_list();
    while (json.next_item()) take();
    return given;
  }

  [[nodiscard]] std::optional<LineKind> kind_of(const GeoShape& shape,
                                                const LineProperties& properties) {
    if (properties.kind) return fields::line_kind(*properties.kind);
    if (properties.left.is_there || properties.right.is_there) return LineKind::wall;
    if (properties.values.is_there || !shape.heights.empty()) return LineKind::feature;
    return LineKind::soft;
  }

  void add(GeoShape& shape, const LineProperties& properties) {
    const std::string& place = json_.features[shape.feature].place;
    const std::optional<LineKind> kind = kind_of(shape, properties);
    if (!kind) {
      complain(place,
               "kind " + in_quotes(*properties.kind) + "; known: feature, soft, wall, barrier");
      return;
    }
    FieldLine line{.place = std::string(name_) + ": " + place, .kind = *kind, .points = {}};
    const bool is_ring = shape.kind == GeoKind::ring;
    if (is_ring && shape.points.size() > 1 && shape.points.front() == shape.points.back()) {
      shape.points.pop_back();
      if (!shape.heights.empty()) shape.heights.pop_back();
    }
    if (is_ring) line.ends = cdt::closed;
    line.points = std::move(shape.points);
    if (line.kind == LineKind::feature && !properties.values.is_there) {
      line.values = heights(shape, place, line.points.size());
    } else if (line.kind == LineKind::feature) {
      line.values = spread(properties.values, "values", place, line.points.size());
    } else if (line.kind == LineKind::wall) {
      line.left = spread(properties.left, "left", place, line.points.size());
      line.right = spread(properties.right, "right", place, line.points.size());
    }
    lines_.push_back(std::move(line));
  }

  std::vector<double> heights(GeoShape& shape, const std::string& place, std::size_t count) {
    if (shape.heights.size() == count &&
        std::ranges::all_of(shape.heights, fields::Field::is_usable))
      return std::move(shape.heights);
    complain(
        place,
        "a feature needs a property values, or a finite height (third coordinate) at each point");
    return {};
  }

  std::vector<double> spread(const GivenValues& given, const std::string& key,
                             const std::string& place, std::size_t count) {
    if (!given.is_there) {
      complain(place,
               "a wall needs the property " + key + ", a number or a list of one for each point");
    } else if (!given.is_list) {
      return std::vector<double>(count, given.numbers.front());
    } else if (given.numbers.size() != count) {
      complain(place, key + ": " + std::to_string(given.numbers.size()) + " numbers for " +
                          std::to_string(count) + " points");
    }
    return given.numbers;
  }

  std::string_view name_;
  GeoJson json_;
  Problems problems_;
  std::vector<FieldLine> lines_;
};

}  // namespace

std::vector<FieldLine> read_field_lines_geojson(std::string_view text, std::string_view name) {
  return FieldLineReader(text, name).read();
}

}  // namespace loft::io
