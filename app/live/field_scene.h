// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "app/live/scene.h"
#include "fields/field.h"
#include "fields/profile.h"
#include "io/planar/map.h"

namespace loft::app {

/// Tab Field: samples with values and lines that shape the surface through them, and a line over it
/// whose profile is shown.
///
///     move      a sample to a place; a line, or the profile's, by a vector from where it was given
///     reshape   the profile's line, or another one, which stays what it is; where it has values,
///     as
///               many points as before
///     insert    a sample with a value (default: that of the surface there); with the name `soft`
///     or
///               `barrier` a line
///     remove    a sample or a line
///     set       value (id, value), cubic (value: 0 or 1)
///
/// It knows `raster`, as numbers: columns, rows, the lowest and the highest value, the box, then
/// the rows from the top; `isolines`, `profile`, and `value` (at).
class FieldScene : public Scene {
 public:
  /// A valley with a river, a dam across it, and the lake before that.
  FieldScene();
  /// Points with a `value` (or z, height) are samples; lines are soft, or what their property
  /// `kind` says, barrier or soft.
  explicit FieldScene(const io::Map& map);

  [[nodiscard]] Json state() const override;
  Json apply(const Edit& edit) override;
  [[nodiscard]] Json answer(const Question& question) override;
  [[nodiscard]] std::optional<std::string> bytes(const Question& question) override;
  [[nodiscard]] const cdt::Triangulation& mesh() const override { return field_.mesh(); }
  [[nodiscard]] const fields::Field& field() const { return field_; }

 private:
  struct Line {
    fields::LineKind kind;
    std::vector<cdt::Point> points = {};  // as they were given
    cdt::Ends ends = cdt::open;
    std::vector<double> values = {};  // of a feature, one for each point
    std::vector<double> left = {};    // of a wall
    std::vector<double> right = {};
    cdt::Point at{};
    std::optional<fields::LineId> id{};  // none: that of the profile
  };

  ItemId add_sample(cdt::Point place, double value);
  ItemId add_line(Line line);
  void add_river(double from, double to, double first_level, double last_level);
  void add_lake();
  void add_hills();
  void add_dam();
  void add_profile();
  [[nodiscard]] static fields::Line in_field(const Line& line, std::span<const cdt::Point> points);
  [[nodiscard]] fields::Smoothness smoothness() const;
  [[nodiscard]] std::vector<double> levels() const;
  [[nodiscard]] std::pair<double, double> range() const;

  void move(const Edit& edit, Json& change);
  void place_line(Line& line, cdt::Point at, std::vector<cdt::Point> points);
  void insert(const Edit& edit, Json& change);
  void remove(const Edit& edit, Json& change);
  void set(const Edit& edit, Json& change);
  [[nodiscard]] Line& known_line(const Edit& edit);
  [[nodiscard]] Json sample_as_json(ItemId id) const;
  [[nodiscard]] Json line_as_json(ItemId id) const;
  [[nodiscard]] Json isolines_as_json() const;
  [[nodiscard]] Json profile_as_json() const;
  [[nodiscard]] std::string raster() const;

  fields::Field field_;
  std::map<ItemId, fields::SampleId> samples_;
  std::map<ItemId, Line> lines_;
  ItemId next_ = 1;
  ItemId profile_ = 0;
  cdt::Box box_;
  bool is_cubic_ = false;
};

}  // namespace loft::app
