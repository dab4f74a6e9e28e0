// SPDX-License-Identifier: MIT
#include "app/live/classes_scene.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/live/dice.h"
#include "io/bytes/text.h"

namespace loft::app {

namespace {

using cdt::Point;
using fields::PointId;
using fields::Sign;

std::string word_of(std::span<const Sign> signs) {
  std::string word;
  for (const Sign sign : signs) word += sign == Sign::left ? '+' : sign == Sign::right ? '-' : '0';
  return word;
}

/// A number around a middle, the sum of three.
double around(Dice& dice, double middle, double spread) {
  return middle + spread * (dice.between(-1, 1) + dice.between(-1, 1) + dice.between(-1, 1));
}

bool has_length(const std::vector<Point>& line) {
  for (std::size_t i = 1; i < line.size(); ++i)
    if (line[i] == line[i - 1]) return false;
  return line.size() >= 2;
}

}  // namespace

// --- What there is at first ---

/// Years of age, and three times those of education, so that both axes are as long; the value is
/// what they earn.
ClassesScene::ClassesScene() {
  box_ = {{16, 0}, {92, 66}};
  Dice dice(9);
  std::vector<Point> points;
  std::vector<double> values;
  while (points.size() < 1600) {
    const double age = around(dice, 48, 17);
    const double schooling = around(dice, 42 - 0.12 * (age - 40), 12);
    if (age < 16 || age > 92 || schooling < 1 || schooling > 65) continue;
    points.push_back({age, schooling});
    values.push_back(schooling / 3 + std::sin((age - 16) / 24.2) * 12 + dice.between(-3, 3));
  }
  add_points(points, values);
  add_separator({{30, 8}, {40, 28}, {44, 44}, {38, 60}});
  add_separator({{22, 30}, {48, 36}, {70, 33}, {86, 45}});
}

ClassesScene::ClassesScene(const io::Map& map) {
  std::vector<Point> points;
  std::vector<double> values;
  for (const io::Feature& feature : map.features) {
    points.insert(points.end(), feature.points.begin(), feature.points.end());
    values.resize(points.size(), value_of(feature));
  }
  for (const Point& p : points) box_.add(p);
  add_points(points, values);
  for (const io::Feature& feature : map.features) {
    for (const auto& line : feature.lines) {
      if (!has_length(line) || separators_.size() == most_separators) continue;
      for (const Point& p : line) box_.add(p);
      add_separator(line);
    }
  }
  if (!(box_.low.x < box_.high.x) || !(box_.low.y < box_.high.y)) {
    box_.add({box_.is_empty() ? 0 : box_.low.x - 1, box_.is_empty() ? 0 : box_.low.y - 1});
    box_.add({box_.high.x + 1, box_.high.y + 1});
  }
  const auto at = [&](double x, double y) {
    return Point{box_.low.x + x * (box_.high.x - box_.low.x),
                 box_.low.y + y * (box_.high.y - box_.low.y)};
  };
  if (!separators_.empty()) return;
  add_separator({at(0.5, 0.1), at(0.5, 0.5), at(0.45, 0.9)});
  add_separator({at(0.1, 0.5), at(0.5, 0.45), at(0.9, 0.5)});
}

void ClassesScene::add_points(const std::vector<Point>& points, const std::vector<double>& values) {
  for (const PointId point : classes_.insert(points, values)) {
    if (point.index() >= ids_.size()) ids_.resize(point.index() + 1);
    ids_[point.index()] = next_;
    points_.emplace(next_++, point);
  }
}

ItemId ClassesScene::add_point(Point at, double value) {
  add_points({at}, {value});
  return next_ - 1;
}

ItemId ClassesScene::add_separator(std::vector<Point> points) {
  const fields::SeparatorId id = classes_.insert_separator(points);
  separators_.emplace(next_, Line{.id = id, .points = std::move(points)});
  return next_++;
}

// --- What the page is told ---

/// Short, as there are many: id, x, y, value, class.
Json ClassesScene::point_as_json(PointId point) const {
  const Point p = classes_.point(point);
  return Json::array(
      {ids_[point.index()], p.x, p.y, classes_.value(point), word_of(classes_.signs(point))});
}

Json ClassesScene::separator_as_json(ItemId id) const {
  const Line& line = separators_.at(id);
  return {{"id", id}, {"at", app::as_json(line.at)}, {"points", flat(line.points)}};
}

/// What the box falls into, a tenth larger.
Json ClassesScene::faces() const {
  const double more_x = (box_.high.x - box_.low.x) / 10;
  const double more_y = (box_.high.y - box_.low.y) / 10;
  const cdt::Box box{{box_.low.x - more_x, box_.low.y - more_y},
                     {box_.high.x + more_x, box_.high.y + more_y}};
  Json faces = Json::array();
  for (const fields::ClassFace& face : classes_.faces(box)) {
    Json rings = Json::array({flat(face.polygon.outer)});
    for (const overlay::Ring& hole : face.polygon.holes) rings.push_back(flat(hole));
    faces.push_back({{"class", word_of(face.signs)}, {"rings", std::move(rings)}});
  }
  return faces;
}

Json ClassesScene::changed() const {
  Json points = Json::array();
  for (const PointId point : classes_.changed()) points.push_back(point_as_json(point));
  return points;
}

Json ClassesScene::state() const {
  Json state{{"box", app::as_json(box_)}};
  state["points"] = Json::array();
  for (const auto& [id, point] : points_) state["points"].push_back(point_as_json(point));
  state["separators"] = Json::array();
  for (const auto& [id, line] : separators_) state["separators"].push_back(separator_as_json(id));
  state["faces"] = faces();
  add_cost(state);
  return state;
}

// --- Edits ---

Json ClassesScene::apply(const Edit& edit) {
  Json change;
  if (edit.kind == Edit::Kind::set) throw Refusal(422, "nothing can be set here");
  if (edit.kind == Edit::Kind::insert)
    insert(edit, change);
  else if (points_.contains(*edit.id))
    edit_point(edit, change);
  else
    edit_separator(edit, change);
  add_cost(change);
  return change;
}

void ClassesScene::edit_point(const Edit& edit, Json& change) {
  const PointId point = points_.at(*edit.id);
  if (edit.kind == Edit::Kind::move) {
    measure_edit([&] { classes_.move(point, *edit.at); });
    change["points"] = Json::array({point_as_json(point)});
  } else if (edit.kind == Edit::Kind::remove) {
    measure_edit([&] { classes_.remove(point); });
    points_.erase(*edit.id);
    change["removed"] = Json::array({*edit.id});
  } else {
    throw Refusal(422, "points are moved and removed");
  }
}

void ClassesScene::edit_separator(const Edit& edit, Json& change) {
  const auto found = separators_.find(*edit.id);
  if (found == separators_.end()) throw Refusal(422, "there is no such point or separator");
  Line& line = found->second;
  if (edit.kind == Edit::Kind::remove) {
    measure_edit([&] { classes_.remove(line.id); });
    separators_.erase(found);
    change["removed"] = Json::array({*edit.id});
  } else {
    const bool is_move = edit.kind == Edit::Kind::move;
    measure_edit(
        [&] { move_to(line, is_move ? *edit.at : Point{}, is_move ? line.points : edit.points); });
    change["separators"] = Json::array({separator_as_json(*edit.id)});
  }
  change["points"] = changed();
  change["faces"] = faces();
}

void ClassesScene::move_to(Line& line, Point at, std::vector<Point> points) {
  const std::vector<Point> there = shifted(points, at);
  for (const Point& p : there)
    if (std::abs(p.x) > 1e70 || std::abs(p.y) > 1e70) throw Refusal(422, "that is too far away");
  classes_.move(line.id, there);
  line.at = at;
  line.points = std::move(points);
}

void ClassesScene::insert(const Edit& edit, Json& change) {
  if (edit.name.empty()) {
    if (points_.size() >= 10 * most_items) throw Refusal(422, "there are as many points as may be");
    measure_edit([&] { add_point(edit.points.front(), edit.value.value_or(0)); });
    change["points"] = changed();
    return;
  }
  if (edit.name != "separator") throw Refusal(422, "points and separators can be inserted");
  if (separators_.size() >= most_separators)
    throw Refusal(422, "there are as many separators as there may be");
  for (const Point& p : edit.points)
    if (std::abs(p.x) > 1e70 || std::abs(p.y) > 1e70) throw Refusal(422, "that is too far away");
  ItemId id = 0;
  measure_edit([&] { id = add_separator(edit.points); });
  change["separators"] = Json::array({separator_as_json(id)});
  change["points"] = changed();
  change["faces"] = faces();
}

}  // namespace loft::app
