// SPDX-License-Identifier: MIT
#include "app/commands/field_tables.h"

#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "app/commands/map_layers.h"
#include "app/report.h"
#include "fields/isolines.h"
#include "fields/profile.h"
#include "io/bytes/csv_field.h"
#include "io/bytes/json_reader.h"
#include "reconstruct/number_text.h"

namespace loft::app {

namespace {

/// As a cell, and as JSON.
std::string cell(std::optional<double> value) { return value ? exact(*value) : std::string(); }
std::string json_number(std::optional<double> value) { return value ? exact(*value) : "null"; }

/// A number or, of an infinite one, nothing.
std::string json_bound(double bound) { return std::isfinite(bound) ? exact(bound) : "null"; }

}  // namespace

FieldAnswer values_at(const FieldView& view, const io::PointTable& places) {
  FieldAnswer answer;
  for (const std::string& name : places.names()) answer.table += io::csv_field(name) + ',';
  answer.table += "value\r\n";
  std::size_t without = 0;
  for (std::size_t row = 0; row < places.points().size(); ++row) {
    const cdt::Point place = places.points()[row];
    const std::optional<double> value =
        view.field.value(place, view.smoothness, fields::Side::left, view.outside);
    without += value ? 0U : 1U;
    for (std::size_t i = 0; i < places.names().size(); ++i)
      answer.table += io::csv_field(places.cell(row, i)) + ',';
    answer.table += cell(value) + "\r\n";
    answer.map.features.push_back(
        {.points = {place}, .properties = "{\"value\":" + json_number(value) + '}'});
  }
  answer.words = ", asked at " + counted(places.points().size(), "place");
  if (without > 0) answer.words += ", " + grouped(without) + " without value";
  answer.report["points"] = places.points().size();
  answer.report["without_value"] = without;
  return answer;
}

FieldAnswer profiles_along(const FieldView& view, const io::Map& lines,
                           const std::filesystem::path& file) {
  FieldAnswer answer{.table = "line,distance,x,y,before,after\r\n"};
  const LayerNames names = by_feature({&lines, 1}, {&file, 1}, {});
  fields::Climb climb;
  std::size_t count = 0;
  for (std::size_t i = 0; i < lines.features.size(); ++i)
    for (const auto& line : lines.features[i].lines) {
      const std::vector<fields::ProfilePoint> profile =
          fields::profile(view.field, line, view.smoothness);
      const fields::Climb own = fields::climb(profile);
      climb = {climb.up + own.up, climb.down + own.down};
      ++count;
      for (const fields::ProfilePoint& point : profile) {
        answer.table += io::csv_field(names.front()[i]) + ',' + exact(point.distance) + ',' +
                        exact(point.place.x) + ',' + exact(point.place.y) + ',' +
                        cell(point.before) + ',' + cell(point.after) + "\r\n";
        std::string properties = "{\"line\":";
        io::append_json_string(properties, names.front()[i]);
        properties += ",\"distance\":" + exact(point.distance) +
                      ",\"before\":" + json_number(point.before) +
                      ",\"after\":" + json_number(point.after) + '}';
        answer.map.features.push_back(
            {.points = {point.place}, .properties = std::move(properties)});
      }
    }
  answer.words =
      ", " + counted(count, "profile") + ", up " + exact(climb.up) + ", down " + exact(climb.down);
  answer.report["profiles"] = count;
  answer.report["climb"] = climb.up;
  answer.report["descent"] = climb.down;
  return answer;
}

FieldAnswer isolines_at(const FieldView& view, std::span<const double> levels) {
  FieldAnswer answer;
  for (fields::Isoline& line : fields::isolines(view.field, levels)) {
    if (line.is_closed) line.points.push_back(line.points.front());
    answer.map.features.push_back(
        {.lines = {std::move(line.points)}, .properties = "{\"level\":" + exact(line.level) + '}'});
  }
  answer.words = ", " + counted(answer.map.features.size(), "isoline");
  answer.report["levels"] = std::vector<double>(levels.begin(), levels.end());
  answer.report["isolines"] = answer.map.features.size();
  return answer;
}

FieldAnswer bands_between(const FieldView& view, std::span<const double> levels) {
  FieldAnswer answer;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::vector<double> bounds{-infinity};
  bounds.insert(bounds.end(), levels.begin(), levels.end());
  bounds.push_back(infinity);
  for (fields::Band& band : fields::bands(view.field, bounds)) {
    if (band.polygons.empty()) continue;
    std::string properties = "{\"low\":" + json_bound(band.low) +
                             ",\"high\":" + json_bound(band.high) +
                             ",\"area\":" + exact(overlay::area(band.polygons).to_double()) + '}';
    answer.map.features.push_back(
        {.polygons = std::move(band.polygons), .properties = std::move(properties)});
  }
  answer.words = ", " + counted(answer.map.features.size(), "band");
  answer.report["levels"] = std::vector<double>(levels.begin(), levels.end());
  answer.report["bands"] = answer.map.features.size();
  return answer;
}

}  // namespace loft::app
