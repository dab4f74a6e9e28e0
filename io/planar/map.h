// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cdt/point.h"
#include "overlay/polygon.h"

namespace loft::io {

/// A thing on a map: a country, a river, some towns.
struct Feature {
  overlay::MultiPolygon polygons = {};  ///< as they are written: in any direction, valid or not
  std::vector<std::vector<cdt::Point>> lines = {};
  std::vector<cdt::Point> points = {};
  std::string id = {};          ///< as JSON text; empty where there is none
  std::string properties = {};  ///< an object as JSON text; empty where there is none

  friend bool operator==(const Feature&, const Feature&) = default;
};

struct Map {
  std::vector<Feature> features = {};
  std::string crs = {};  ///< the coordinate system as JSON text; empty where nothing is said of it

  friend bool operator==(const Map&, const Map&) = default;
};

/// A property as text: a string, or a number, true or false as it is written. None where there is
/// none, or it is something else.
[[nodiscard]] std::optional<std::string> property(const Feature& feature, std::string_view key);

/// What a feature is called: its id, a text or a number, or else its property `name`. None where it
/// has neither.
[[nodiscard]] std::optional<std::string> id_or_name(const Feature& feature);

/// The names of all properties of a feature.
[[nodiscard]] std::vector<std::string> property_names(const Feature& feature);

}  // namespace loft::io
