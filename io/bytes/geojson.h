// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cdt/point.h"
#include "io/bytes/json_reader.h"

namespace loft::io {

enum class GeoKind : std::uint8_t { point, line, ring };

/// A point, a line or a ring of GeoJSON; a ring repeats its first point, as it is in the text.
struct GeoShape {
  GeoKind kind = GeoKind::point;
  std::vector<cdt::Point> points;    ///< one at least
  std::vector<double> heights = {};  ///< of all points, not always finite; empty where one has none
  std::size_t feature = 0;           ///< index of its feature
  bool is_hole = false;              ///< a ring of a polygon that has one before it
};

/// What shapes belong to. Its members are bookmarks in the text.
struct GeoFeature {
  std::string place;  ///< `feature 12 `; empty for a geometry alone
  std::optional<JsonReader> id = {};
  std::optional<JsonReader> properties = {};

  /// A property; none where there is none, or it is something else.
  [[nodiscard]] std::optional<std::string> text(std::string_view key) const;
  [[nodiscard]] std::optional<double> number(std::string_view key) const;
  [[nodiscard]] std::vector<std::string> names() const;  ///< of all properties
};

struct GeoJson {
  std::vector<GeoFeature> features;
  std::vector<GeoShape> shapes;
  std::optional<JsonReader> crs;  ///< its coordinate system, where it says it; a bookmark

  /// The name of the coordinate system; empty where there is none.
  [[nodiscard]] std::string crs_name() const;
};

/// Reads GeoJSON (RFC 7946): a feature collection, a feature or a geometry of any type. Null and
/// empty geometries have no shapes. The text must outlive what comes back.
///
/// Throws InputError that names `name`, feature, part and point of each bad place, or says that
/// there is no shape. Cost: O(n), no document tree is built; however deep the text is nested, the
/// stack is not.
[[nodiscard]] GeoJson read_geojson(std::string_view text, std::string_view name);

}  // namespace loft::io
