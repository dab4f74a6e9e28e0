// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "app/json.h"
#include "fields/field.h"
#include "io/planar/map.h"
#include "io/planar/point_table.h"

namespace loft::app {

/// A field, and how it is looked at.
struct FieldView {
  const fields::Field& field;
  fields::Smoothness smoothness = fields::Smoothness::linear;
  fields::Outside outside = fields::Outside::nothing;
};

/// What is answered.
struct FieldAnswer {
  std::string table = {};  ///< as CSV
  io::Map map = {};
  std::string words = {};  ///< for the summary, a comma before them
  Json report = Json::object();
};

/// The values at places: their rows as they are, with a column `value` behind, which is empty where
/// there is none.
[[nodiscard]] FieldAnswer values_at(const FieldView& view, const io::PointTable& places);

/// The values along each line of a map: a row for each place where a triangle's edge is crossed.
/// `before` and `after` differ where the line crosses a wall.
[[nodiscard]] FieldAnswer profiles_along(const FieldView& view, const io::Map& lines,
                                         const std::filesystem::path& file);

/// Lines with the property `level`; polygons with `low` and `high`.
[[nodiscard]] FieldAnswer isolines_at(const FieldView& view, std::span<const double> levels);
[[nodiscard]] FieldAnswer bands_between(const FieldView& view, std::span<const double> levels);

}  // namespace loft::app
