// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <vector>

#include "app/live/scene.h"
#include "fields/classes.h"
#include "io/planar/map.h"

namespace loft::app {

/// Tab Classes: points and separators, lines that go on to infinity; a class is on which side of
/// each of them a point is: `+` left, `-` right, `0` on it, in the order of the separators.
///
///     move      a point to a place; a separator by a vector from where it was given
///     reshape   a separator
///     insert    a point, with a value; with the name `separator` one of these
///     remove    a point or a separator
class ClassesScene : public Scene {
 public:
  /// People by age and education, and two separators.
  ClassesScene();
  /// The points of a map, and its lines as separators, two where it has none.
  explicit ClassesScene(const io::Map& map);

  [[nodiscard]] Json state() const override;
  Json apply(const Edit& edit) override;
  [[nodiscard]] const cdt::Triangulation& mesh() const override { return classes_.triangulation(); }
  [[nodiscard]] const fields::Classes& classes() const { return classes_; }

 private:
  static constexpr std::size_t most_separators = 8;

  struct Line {
    fields::SeparatorId id;
    std::vector<cdt::Point> points;  // as they were given
    cdt::Point at{};
  };

  ItemId add_point(cdt::Point place, double value);
  ItemId add_separator(std::vector<cdt::Point> points);
  void add_points(const std::vector<cdt::Point>& points, const std::vector<double>& values);
  void edit_point(const Edit& edit, Json& change);
  void edit_separator(const Edit& edit, Json& change);
  void insert(const Edit& edit, Json& change);
  void move_to(Line& line, cdt::Point at, std::vector<cdt::Point> points);
  [[nodiscard]] Json point_as_json(fields::PointId point) const;
  [[nodiscard]] Json separator_as_json(ItemId id) const;
  [[nodiscard]] Json faces() const;
  [[nodiscard]] Json changed() const;

  fields::Classes classes_;
  std::map<ItemId, fields::PointId> points_;
  std::vector<ItemId> ids_;  // by point
  std::map<ItemId, Line> separators_;
  ItemId next_ = 1;
  cdt::Box box_;
};

}  // namespace loft::app
