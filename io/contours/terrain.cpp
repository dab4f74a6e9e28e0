// SPDX-License-Identifier: MIT
#include "io/contours/terrain.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <system_error>
#include <utility>

#include "io/bytes/geojson.h"
#include "io/bytes/problems.h"
#include "io/bytes/text.h"
#include "io/bytes/utf8.h"
#include "io/contours/bands.h"
#include "io/contours/heights.h"
#include "io/contours/isolines.h"
#include "io/contours/stack_builder.h"
#include "io/contours/winding.h"
#include "mesh/admitted.h"
#include "reconstruct/usable.h"

namespace loft::io {

namespace {

constexpr std::array usual_names{"ELEV", "elev", "elevation", "height", "z", "CONTOUR"};
constexpr std::array band_names{"EMIN", "ELEV_MIN"};

/// A property that is a number, or a text that is one.
std::optional<double> height_in(const GeoFeature& feature, std::string_view property) {
  if (const auto number = feature.number(property)) return number;
  const auto text = feature.text(property);
  if (!text) return {};
  double number = 0;
  const auto [end, error] = std::from_chars(text->data(), text->data() + text->size(), number);
  if (error != std::errc() || end != text->data() + text->size()) return {};
  return number;
}

/// A shape of the file with its height, or heights.
struct Raised {
  GeoShape* shape;
  double lowest;
  double highest;
};

class TerrainReader {
 public:
  TerrainReader(const StackInput& input, const ReadOptions& options)
      : json_(read_geojson(input.bytes, input.name)),
        name_(input.name),
        options_(options),
        builder_(input.name) {}

  Stack read() {
    raise_shapes();
    problems_.raise(name_);
    refuse_degrees();
    level_ = HeightGroups(heights());
    if (is_bands_) {
      add_bands();
    } else {
      add_shapes();
    }
    stack_.fill = has_lines_ || is_bands_ ? Fill::even_odd : Fill::nonzero;
    builder_.finish(stack_,
                    "a terrain is drawn as closed isolines or polygons, each with its height");
    return std::move(stack_);
  }

 private:
  [[nodiscard]] const GeoFeature& feature(const GeoShape& shape) const {
    return json_.features[shape.feature];
  }
  [[nodiscard]] std::string label(const GeoShape& shape) const {
    return json_text(one_line(feature(shape).text("label").value_or("")));
  }
  [[nodiscard]] std::string source(const GeoShape& shape) const {
    const std::string& place = feature(shape).place;
    return place.empty() ? "geometry" : place.substr(0, place.find_last_not_of(' ') + 1);
  }

  [[nodiscard]] bool any_has(std::string_view property) const {
    return std::ranges::any_of(json_.features, [&](const GeoFeature& one) {
      return height_in(one, property).has_value();
    });
  }

  /// Third coordinates that differ somewhere.
  [[nodiscard]] bool has_heights() const {
    std::optional<double> first;
    bool differ = false;
    for (const GeoShape& shape : json_.shapes) {
      if (shape.heights.empty()) return false;
      first = first.value_or(shape.heights.front());
      for (const double z : shape.heights) differ = differ || z != *first;
    }
    return differ;
  }

  /// The property that has the heights; none where third coordinates have them.
  std::optional<std::string> find_property() {
    if (!options_.z_property.empty()) {
      if (!any_has(options_.z_property))
        throw InputError(std::string(name_) + ": no feature has a number " +
                         in_quotes(options_.z_property) + known_properties());
      return options_.z_property;
    }
    if (has_heights()) return {};
    const auto is_there = [&](const char* property) { return any_has(property); };
    const bool has_rings = std::ranges::any_of(
        json_.shapes, [](const GeoShape& shape) { return shape.kind == GeoKind::ring; });
    const auto band = std::ranges::find_if(band_names, is_there);
    if (has_rings && band != band_names.end()) {
      is_bands_ = true;
      stack_.notes.push_back("bands: a slice at each height in the property " + std::string(*band) +
                             " is this band and all above it");
      return *band;
    }
    const auto found = std::ranges::find_if(usual_names, is_there);
    if (found == usual_names.end())
      throw InputError(std::string(name_) + ": has no heights: no third coordinates that differ, " +
                       "no property ELEV, elev, elevation, height, z or CONTOUR" +
                       known_properties());
    stack_.notes.push_back("heights are the property " + std::string(*found));
    return *found;
  }

  [[nodiscard]] std::string known_properties() const {
    std::string known;
    for (const std::string& one :
         json_.features.empty() ? std::vector<std::string>() : json_.features.front().names())
      known += (known.empty() ? "" : ", ") + in_quotes(one);
    return "; name the one that has them by --z-property" +
           (known.empty() ? std::string() : "; the first feature has " + known);
  }

  /// Gives each shape its heights; counts those that have none.
  void raise_shapes() {
    const std::optional<std::string> property = find_property();
    std::vector<std::optional<double>> of_feature;
    if (property)
      for (const GeoFeature& one : json_.features) of_feature.push_back(height_in(one, *property));
    for (GeoShape& shape : json_.shapes) {
      for (const cdt::Point& point : shape.points)
        if (!check(shape, point.x, "x") || !check(shape, point.y, "y")) break;
      if (shape.kind == GeoKind::point) {
        builder_.skip(label(shape), "point");
      } else if (!property) {
        const auto is_good = [&](double z) { return check(shape, z, "height"); };
        if (!std::ranges::all_of(shape.heights, is_good)) continue;
        const auto [low, high] = std::ranges::minmax(shape.heights);
        raised_.push_back({&shape, low, high});
      } else if (const auto z = of_feature[shape.feature]) {
        if (check(shape, *z, "height")) raised_.push_back({&shape, *z, *z});
      } else {
        builder_.skip(label(shape), "line without a height");
      }
    }
  }

  bool check(const GeoShape& shape, double value, const char* what) {
    if (admitted::slice.admits(value)) return true;
    problems_.add(std::string(name_) + ": " + source(shape) + ": " + what + ": " +
                  why_not_admitted(value, admitted::slice));
    return false;
  }

  [[nodiscard]] std::vector<double> heights() const {
    std::vector<double> result;
    for (const Raised& one : raised_) result.push_back(one.lowest);
    return result;
  }

  /// Throws InputError where x and y are longitude and latitude.
  void refuse_degrees() const {
    bool may_be = true;
    double least[3] = {1e300, 1e300, 1e300};
    double most[3] = {-1e300, -1e300, -1e300};
    const auto widen = [&](int axis, double value) {
      least[axis] = std::min(least[axis], value);
      most[axis] = std::max(most[axis], value);
    };
    for (const Raised& one : raised_) {
      widen(2, one.lowest);
      widen(2, one.highest);
      for (const cdt::Point& point : one.shape->points) {
        may_be = may_be && std::abs(point.x) <= 180 && std::abs(point.y) <= 90;
        widen(0, point.x);
        widen(1, point.y);
      }
    }
    const std::string crs = json_.crs_name();
    const bool says_so =
        crs.find("CRS84") != std::string::npos || crs.find("4326") != std::string::npos;
    constexpr double steepest = 20;  // no hill is that high against its map
    const double extent = std::max(most[0] - least[0], most[1] - least[1]);
    const bool is_steep = !raised_.empty() && most[2] - least[2] > steepest * extent;
    if (!may_be || !(says_so || is_steep)) return;
    throw InputError(std::string(name_) + ": x and y are degrees of longitude and latitude, " +
                     (says_so ? "by its coordinate system" : "as it seems by their extent") +
                     ", heights are not; project it: ogr2ogr -t_srs EPSG:3857 OUT.geojson IN");
  }

  void add_bands() {
    std::vector<BandRing> rings;
    for (const Raised& one : raised_) {
      if (one.shape->kind != GeoKind::ring) {
        builder_.skip("", "line beside the bands");
        continue;
      }
      rings.push_back({std::move(one.shape->points), level_.of(one.lowest)});
    }
    add_slices(sum_bands(rings, name_));
  }

  void add_slices(std::vector<Slice> slices) {
    for (Slice& slice : slices) {
      builder_.add_height(slice.z);
      for (Contour& contour : slice.contours) builder_.add(std::move(contour), slice.z);
    }
  }

  void add_shapes() {
    std::vector<Isoline> lines;
    for (const Raised& one : raised_) {
      std::vector<cdt::Point>& points = one.shape->points;
      if (one.shape->kind == GeoKind::ring) {
        if ((doubled_area(points) < 0) != one.shape->is_hole) std::ranges::reverse(points);
        builder_.add({std::move(points), label(*one.shape), source(*one.shape)}, one.lowest,
                     one.highest);
        continue;
      }
      has_lines_ = true;
      if (level_.of(one.lowest) != level_.of(one.highest)) {
        builder_.skip(label(*one.shape), "line that is in no plane");
      } else if (points.size() < 2) {
        builder_.skip(label(*one.shape), "point");
      } else {
        Isoline line{std::move(points), level_.of(one.lowest), false, source(*one.shape),
                     label(*one.shape)};
        line.is_closed = line.points.front() == line.points.back();
        if (line.is_closed) line.points.pop_back();
        lines.push_back(std::move(line));
      }
    }
    if (!lines.empty()) add_lines(std::move(lines));
  }

  void add_lines(std::vector<Isoline> lines) {
    const auto is_open = [](const Isoline& line) { return !line.is_closed; };
    if (std::ranges::any_of(lines, is_open)) join_isolines(lines);
    const auto open = static_cast<std::size_t>(std::ranges::count_if(lines, is_open));
    if (options_.open_lines == OpenLines::close_along_border) {
      stack_.notes.push_back(counted(open, "isoline") + " closed along the border of the data");
      return add_slices(close_along_border(lines, name_));
    }
    if (open > 0)
      throw InputError(std::string(name_) + ": " + std::to_string(open) + " of " +
                       counted(lines.size(), "isoline") + " " + (open == 1 ? "is" : "are") +
                       " open: they end at the border of the data; --close border closes them " +
                       "along it");
    for (Isoline& line : lines)
      builder_.add({std::move(line.points), std::move(line.label), std::move(line.source)}, line.z);
  }

  GeoJson json_;
  std::string_view name_;
  const ReadOptions& options_;
  StackBuilder builder_;
  Problems problems_;
  Stack stack_;
  std::vector<Raised> raised_;
  HeightGroups level_{{}};
  bool is_bands_ = false;
  bool has_lines_ = false;
};

}  // namespace

Stack read_terrain(const StackInput& input, const ReadOptions& options) {
  return TerrainReader(input, options).read();
}

bool begins_like_terrain(std::string_view bytes) {
  bytes = without_mark(bytes);
  for (const std::string_view word : {"{", "\"type\"", ":", "\"FeatureCollection\""}) {
    bytes.remove_prefix(std::min(bytes.find_first_not_of(" \t\r\n"), bytes.size()));
    if (!bytes.starts_with(word)) return false;
    bytes.remove_prefix(word.size());
  }
  return true;
}

}  // namespace loft::io
