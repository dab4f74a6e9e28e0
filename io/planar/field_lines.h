// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cdt/point.h"
#include "fields/field.h"

namespace loft::io {

/// A line of a file, and what it says of the values over the plane.
struct FieldLine {
  std::string place;  ///< what messages call it: `lines.geojson: feature 3`
  fields::LineKind kind = fields::LineKind::soft;
  std::vector<cdt::Point> points;
  std::vector<double> values = {};  ///< as fields::Line has them
  std::vector<double> left = {};
  std::vector<double> right = {};
  cdt::Ends ends = cdt::open;

  [[nodiscard]] fields::Line view() const {
    return {.points = points,
            .kind = kind,
            .values = values,
            .left = left,
            .right = right,
            .ends = ends};
  }
};

/// Reads GeoJSON: each line and each ring of a polygon. A feature's property `kind` is `feature`,
/// `soft`, `wall` or `barrier`; without it, one with `left` and `right` is a wall, one with
/// `values` or with heights (third coordinates) a feature, any other soft. Values are a number for
/// all points or a list with one for each: `left` and `right` of a wall, `values` of a feature,
/// which may have heights instead. Points are left out.
///
/// Throws InputError that names `name` and the feature of each bad place: unknown kinds, values
/// that are missing, not finite, or not as many as the points are. Cost: O(n).
[[nodiscard]] std::vector<FieldLine> read_field_lines_geojson(std::string_view text,
                                                              std::string_view name);

}  // namespace loft::io
