// SPDX-License-Identifier: MIT
#include "app/live/field_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "app/live/dice.h"
#include "fields/isolines.h"
#include "fields/raster.h"

namespace loft::app {

namespace {

using cdt::Point;
using fields::LineKind;
using fields::Smoothness;

constexpr double columns_of_raster = 280;

/// How high the made-up valley is: hills on both sides of a bed that winds.
constexpr double lake_level = 112;

double bed(double x) { return 50 + 14 * std::sin(x / 26) + 4 * std::sin(x / 9); }
double height(Point p) {
  const double aside = std::abs(p.y - bed(p.x));
  const double hills =
      9 * std::sin(p.x / 17 + 1) + 7 * std::cos(p.y / 13) + 5 * std::sin((p.x - p.y) / 11);
  return 120 - 0.35 * p.x + 58 * aside / (aside + 16) + hills * std::min(1.0, aside / 20);
}

double lake_width(double x) { return x > 50 ? 7 : 5; }

/// 1, 2 or 5 times a power of ten: some ten steps.
double nice_step(double range) {
  const double rough = range / 12;
  const double power = std::pow(10, std::floor(std::log10(rough)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (rough <= factor * power) return factor * power;
  return 10 * power;
}

}  // namespace

// --- What there is at first ---

FieldScene::FieldScene() {
  box_ = {{0, 0}, {160, 100}};
  add_river(0, 30, 118, lake_level);
  add_lake();
  add_river(66, 160, 94, 62);
  add_hills();
  add_dam();
  add_profile();
}

void FieldScene::add_river(double from, double to, double first_level, double last_level) {
  Line river{.kind = LineKind::feature};
  for (int i = 0; i <= 12; ++i) {
    const double part = i / 12.0;
    const double x = from + part * (to - from);
    river.points.push_back({x, bed(x)});
    river.values.push_back(first_level + part * (last_level - first_level));
  }
  add_line(std::move(river));
}

/// Before the dam, all of it as high.
void FieldScene::add_lake() {
  Line shore{.kind = LineKind::feature, .ends = cdt::closed};
  for (int i = 0; i < 24; ++i) {
    const double angle = 2 * std::numbers::pi * i / 24;
    const double x = 47 - 17 * std::cos(angle);
    shore.points.push_back({x, bed(x) + lake_width(x) * std::sin(angle)});
    shore.values.push_back(lake_level);
  }
  add_line(std::move(shore));
}

void FieldScene::add_hills() {
  Dice dice(5);
  for (int i = 0; i < 20; ++i) {
    for (int j = 0; j < 13; ++j) {
      const Point p{std::clamp(8.42 * i + dice.between(-3, 3), 0.0, 160.0),
                    std::clamp(8.33 * j + dice.between(-3, 3), 0.0, 100.0)};
      const bool is_corner = (i == 0 || i == 19) && (j == 0 || j == 12);
      const double free = p.x > 28 && p.x < 72 ? 9 : 3;
      if (std::abs(p.y - bed(p.x)) > free && !is_corner) add_sample(p, height(p));
    }
  }
  for (const double x : {0.0, 160.0})
    for (const double y : {0.0, 100.0}) add_sample({x, y}, height({x, y}));
}

/// Across the valley: the lake on its right, the river deep below on its left.
void FieldScene::add_dam() {
  Line dam{.kind = LineKind::wall};
  for (const double aside : {11.0, 5.0, 0.0, -5.0, -11.0}) {
    dam.points.push_back({65 + std::abs(aside) / 6, bed(65) + aside});
    dam.left.push_back(std::abs(aside) > 10 ? lake_level : 95);
    dam.right.push_back(lake_level);
  }
  add_line(std::move(dam));
}

FieldScene::FieldScene(const io::Map& map) {
  const auto add_to_box = [&](const std::vector<Point>& points) {
    for (const Point& p : points) box_.add(p);
  };
  std::vector<fields::Sample> samples;
  for (const io::Feature& feature : map.features) {
    add_to_box(feature.points);
    for (const Point& p : feature.points) samples.push_back({p, value_of(feature)});
  }
  for (const fields::SampleId id : field_.insert(samples)) samples_.emplace(next_++, id);
  for (const io::Feature& feature : map.features) {
    const bool is_barrier = io::property(feature, "kind").value_or("") == "barrier";
    for (const auto& line : feature.lines) {
      add_to_box(line);
      if (std::ranges::any_of(line, [&](Point p) { return p != line.front(); }))
        add_line({.kind = is_barrier ? LineKind::barrier : LineKind::soft, .points = line});
    }
  }
  if (box_.is_empty()) box_ = {{0, 0}, {1, 1}};
  add_profile();
}

/// From side to side.
void FieldScene::add_profile() {
  const auto at = [&](double part_x, double part_y) {
    return Point{box_.low.x + part_x * (box_.high.x - box_.low.x),
                 box_.low.y + part_y * (box_.high.y - box_.low.y)};
  };
  profile_ = next_++;
  lines_.emplace(profile_, Line{.kind = LineKind::soft, .points = {at(0.1, 0.52), at(0.64, 0.67)}});
}

ItemId FieldScene::add_sample(Point at, double value) {
  samples_.emplace(next_, field_.insert(fields::Sample{at, value}));
  return next_++;
}

fields::Line FieldScene::in_field(const Line& line, std::span<const Point> points) {
  return {.points = points,
          .kind = line.kind,
          .values = line.values,
          .left = line.left,
          .right = line.right,
          .ends = line.ends};
}

ItemId FieldScene::add_line(Line line) {
  line.id = field_.insert(in_field(line, line.points));
  lines_.emplace(next_, std::move(line));
  return next_++;
}

// --- What the page is told ---

Json FieldScene::sample_as_json(ItemId id) const {
  const fields::Sample sample = field_.sample(samples_.at(id));
  return {{"id", id}, {"at", app::as_json(sample.place)}, {"value", sample.value}};
}

Json FieldScene::line_as_json(ItemId id) const {
  const Line& line = lines_.at(id);
  const std::string kind = line.id ? std::string(fields::name_of(line.kind)) : "profile";
  return {{"id", id},
          {"kind", kind},
          {"at", app::as_json(line.at)},
          {"points", flat(line.points)},
          {"is_closed", line.ends == cdt::closed}};
}

Json FieldScene::state() const {
  Json state{{"box", app::as_json(box_)}, {"profile", profile_}, {"cubic", is_cubic_}};
  state["samples"] = Json::array();
  for (const auto& [id, sample] : samples_) state["samples"].push_back(sample_as_json(id));
  state["lines"] = Json::array();
  for (const auto& [id, line] : lines_) state["lines"].push_back(line_as_json(id));
  add_cost(state);
  return state;
}

Smoothness FieldScene::smoothness() const {
  return is_cubic_ ? Smoothness::cubic : Smoothness::linear;
}

/// The lowest and the highest value that was given.
std::pair<double, double> FieldScene::range() const {
  std::pair range{std::numeric_limits<double>::infinity(),
                  -std::numeric_limits<double>::infinity()};
  const auto add = [&](double value) {
    range = {std::min(range.first, value), std::max(range.second, value)};
  };
  for (const auto& [id, sample] : samples_) add(field_.sample(sample).value);
  for (const auto& [id, line] : lines_)
    for (const auto* values : {&line.values, &line.left, &line.right})
      std::ranges::for_each(*values, add);
  return range.first <= range.second ? range : std::pair(0.0, 0.0);
}

std::vector<double> FieldScene::levels() const {
  const auto [low, high] = range();
  std::vector<double> levels;
  const double step = nice_step(high - low);
  if (!(high > low) || !std::isnormal(step)) return levels;
  const double first = std::ceil(low / step);
  for (int i = 0; i < 40 && (first + i) * step < high; ++i) levels.push_back((first + i) * step);
  return levels;
}

Json FieldScene::answer(const Question& question) {
  if (question.what == "isolines") return isolines_as_json();
  if (question.what == "profile") return profile_as_json();
  if (question.what == "value" && question.at) {
    const auto value = field_.value(*question.at, smoothness());
    return {{"value", value ? Json(*value) : Json(nullptr)}};
  }
  return Scene::answer(question);
}

Json FieldScene::isolines_as_json() const {
  Json lines = Json::array();
  for (const fields::Isoline& line : fields::isolines(field_, levels()))
    lines.push_back(
        {{"level", line.level}, {"is_closed", line.is_closed}, {"points", flat(line.points)}});
  return {{"lines", std::move(lines)}};
}

/// At each place on the way its distance and the values before and after it.
Json FieldScene::profile_as_json() const {
  const Line& line = lines_.at(profile_);
  const auto as_number = [](const std::optional<double>& value) {
    return value ? Json(*value) : Json(nullptr);
  };
  const auto profile = fields::profile(field_, shifted(line.points, line.at), smoothness());
  Json points = Json::array();
  for (const fields::ProfilePoint& point : profile)
    points.push_back({point.distance, as_number(point.before), as_number(point.after)});
  const fields::Climb climb = fields::climb(profile);
  return {{"points", std::move(points)}, {"up", climb.up}, {"down", climb.down}};
}

std::optional<std::string> FieldScene::bytes(const Question& question) {
  if (question.what == "raster") return raster();
  return Scene::bytes(question);
}

std::string FieldScene::raster() const {
  const double width = box_.high.x - box_.low.x;
  const double deep = box_.high.y - box_.low.y;
  const double step = std::max(width, deep) / columns_of_raster;
  if (!(step > 0)) return {};
  const fields::Grid grid{.first = {box_.low.x + step / 2, box_.high.y - step / 2},
                          .step_x = step,
                          .step_y = -step,
                          .columns = static_cast<std::size_t>(std::max(1.0, width / step)),
                          .rows = static_cast<std::size_t>(std::max(1.0, deep / step))};
  const auto [low, high] = range();
  std::string bytes;
  const double right = box_.low.x + static_cast<double>(grid.columns) * step;
  const double bottom = box_.high.y - static_cast<double>(grid.rows) * step;
  for (const double number : {static_cast<double>(grid.columns), static_cast<double>(grid.rows),
                              low, high, box_.low.x, bottom, right, box_.high.y})
    append_float(bytes, number);
  fields::rasterize(field_, grid, smoothness(), [&](std::size_t, std::span<const double> values) {
    for (const double value : values) append_float(bytes, value);
  });
  return bytes;
}

// --- Edits ---

Json FieldScene::apply(const Edit& edit) {
  Json change;
  switch (edit.kind) {
    case Edit::Kind::move:
      move(edit, change);
      break;
    case Edit::Kind::reshape: {
      Line& line = known_line(edit);
      const bool has_values = line.kind == LineKind::feature || line.kind == LineKind::wall;
      if (has_values && edit.points.size() != line.points.size())
        throw Refusal(422, "its values belong to its points: there are as many");
      measure_edit([&] { place_line(line, {}, edit.points); });
      change["lines"] = Json::array({line_as_json(*edit.id)});
      break;
    }
    case Edit::Kind::insert:
      insert(edit, change);
      break;
    case Edit::Kind::remove:
      remove(edit, change);
      break;
    case Edit::Kind::set:
      set(edit, change);
  }
  add_cost(change);
  return change;
}

FieldScene::Line& FieldScene::known_line(const Edit& edit) {
  const auto line = lines_.find(*edit.id);
  if (line == lines_.end()) throw Refusal(422, "there is no such sample or line");
  return line->second;
}

void FieldScene::move(const Edit& edit, Json& change) {
  if (const auto sample = samples_.find(*edit.id); sample != samples_.end()) {
    measure_edit([&] { field_.move(sample->second, *edit.at); });
    change["samples"] = Json::array({sample_as_json(*edit.id)});
    return;
  }
  Line& line = known_line(edit);
  measure_edit([&] { place_line(line, *edit.at, line.points); });
  change["moved"] = Json::array({{{"id", *edit.id}, {"at", app::as_json(*edit.at)}}});
}

void FieldScene::place_line(Line& line, Point at, std::vector<Point> points) {
  const std::vector<Point> there = shifted(points, at);
  for (const Point& p : there)
    if (!cdt::Triangulation::is_usable(p)) throw Refusal(422, "there it is not usable");
  if (line.id) field_.move(*line.id, in_field(line, there));
  line.at = at;
  line.points = std::move(points);
}

void FieldScene::insert(const Edit& edit, Json& change) {
  if (samples_.size() + lines_.size() >= most_items)
    throw Refusal(422, "there are as many samples and lines as there may be");
  ItemId id = 0;
  if (edit.name.empty()) {
    const Point p = edit.points.front();
    const double value =
        edit.value ? *edit.value
                   : field_.value(p, smoothness(), fields::Side::left, fields::Outside::nearest)
                         .value_or(0);
    measure_edit([&] { id = add_sample(p, value); });
    change["samples"] = Json::array({sample_as_json(id)});
    return;
  }
  const auto kind = fields::line_kind(edit.name);
  if (kind != LineKind::soft && kind != LineKind::barrier)
    throw Refusal(422, "lines are soft or barrier");
  measure_edit([&] { id = add_line({.kind = *kind, .points = edit.points}); });
  change["lines"] = Json::array({line_as_json(id)});
}

void FieldScene::remove(const Edit& edit, Json& change) {
  if (const auto sample = samples_.find(*edit.id); sample != samples_.end()) {
    measure_edit([&] { field_.remove(sample->second); });
    samples_.erase(sample);
  } else {
    const Line& line = known_line(edit);
    if (!line.id) throw Refusal(422, "the line of the profile stays");
    measure_edit([&] { field_.remove(*line.id); });
    lines_.erase(*edit.id);
  }
  change["removed"] = Json::array({*edit.id});
}

void FieldScene::set(const Edit& edit, Json& change) {
  const auto sample = samples_.find(edit.id.value_or(0));
  if (edit.name == "cubic" && edit.value) {
    measure_edit([&] { is_cubic_ = *edit.value != 0; });
    change["cubic"] = is_cubic_;
  } else if (edit.name == "value" && edit.value && sample != samples_.end()) {
    measure_edit([&] { field_.set_value(sample->second, *edit.value); });
    change["samples"] = Json::array({sample_as_json(*edit.id)});
  } else {
    throw Refusal(422, "value, of a sample, or cubic can be set");
  }
}

}  // namespace loft::app
