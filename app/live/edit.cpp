// SPDX-License-Identifier: MIT
#include "app/live/edit.h"

#include <array>
#include <charconv>
#include <cmath>
#include <set>
#include <utility>

#include "cdt/triangulation.h"
#include "io/bytes/json_reader.h"
#include "io/bytes/text.h"

namespace loft::app {

namespace {

using cdt::Point;
using io::JsonKind;
using io::JsonReader;

constexpr double largest_id = 4'294'967'295.0;

[[noreturn]] void refuse_edit(const std::string& why) { throw Refusal(400, why); }

void require(JsonReader& json, JsonKind kind, const std::string& what) {
  if (json.peek() != kind) refuse_edit(what);
}

double usable_number(JsonReader& json, const std::string& what) {
  require(json, JsonKind::number, what + " is no number");
  const double value = json.number();
  if (!cdt::Triangulation::is_usable(value))
    refuse_edit(what + ": numbers are 0 or from 1e-50 to 1e75 in magnitude");
  return value;
}

std::string short_text(JsonReader& json, const std::string& what, std::size_t most) {
  require(json, JsonKind::string, what + " is no text");
  std::string text = json.string();
  if (text.size() > most)
    throw Refusal(413, what + " has more than " + std::to_string(most) + " bytes");
  return text;
}

ItemId id_of(double value) {
  if (!(value >= 0 && value <= largest_id) || std::floor(value) != value)
    refuse_edit("id is a whole number from 0 to 4294967295");
  return static_cast<ItemId>(value);
}

Point read_point(JsonReader& json, const std::string& what) {
  require(json, JsonKind::list, what + " is no [x, y]");
  json.begin_list();
  std::array<double, 2> place{};
  std::size_t count = 0;
  while (json.next_item()) {
    if (count == 2) refuse_edit(what + " has more than two numbers");
    place[count++] = usable_number(json, what);
  }
  if (count < 2) refuse_edit(what + " has fewer than two numbers");
  return {place[0], place[1]};
}

std::vector<Point> read_points(JsonReader& json, std::size_t most) {
  require(json, JsonKind::list, "points are no list");
  json.begin_list();
  std::vector<Point> points;
  while (json.next_item()) {
    if (points.size() == most) throw Refusal(413, "more than " + std::to_string(most) + " points");
    points.push_back(read_point(json, "point " + std::to_string(points.size())));
  }
  if (points.empty()) refuse_edit("there is no point");
  return points;
}

Edit::Kind kind_of(const std::string& word) {
  using Kind = Edit::Kind;
  static const std::array<std::pair<const char*, Kind>, 5> kinds{{{"move", Kind::move},
                                                                  {"reshape", Kind::reshape},
                                                                  {"insert", Kind::insert},
                                                                  {"remove", Kind::remove},
                                                                  {"set", Kind::set}}};
  for (const auto& [name, kind] : kinds)
    if (word == name) return kind;
  refuse_edit("do is move, reshape, insert, remove or set");
}

void read_member(JsonReader& json, const std::string& key, const EditLimits& limits, Edit& edit) {
  if (key == "do")
    edit.kind = kind_of(short_text(json, key, limits.most_name));
  else if (key == "id")
    edit.id = id_of(usable_number(json, key));
  else if (key == "at")
    edit.at = read_point(json, key);
  else if (key == "points")
    edit.points = read_points(json, limits.most_points);
  else if (key == "name")
    edit.name = short_text(json, key, limits.most_name);
  else if (key == "text")
    edit.text = short_text(json, key, limits.most_text);
  else if (key == "value")
    edit.value = usable_number(json, key);
  else
    refuse_edit("keys are do, id, at, points, name, text and value");
}

void check_members(const std::set<std::string>& keys, const Edit& edit) {
  const auto need = [&](const char* key) {
    if (!keys.contains(key)) refuse_edit(std::string("it needs ") + key);
  };
  need("do");
  switch (edit.kind) {
    case Edit::Kind::move:
      need("at");
      return need("id");
    case Edit::Kind::reshape:
      need("points");
      return need("id");
    case Edit::Kind::insert:
      return need("points");
    case Edit::Kind::remove:
      return need("id");
    case Edit::Kind::set:
      need("name");
      if (edit.text.has_value() == edit.value.has_value())
        refuse_edit("it needs value or text, one of them");
  }
}

Edit read_object(JsonReader& json, const EditLimits& limits) {
  require(json, JsonKind::object, "an edit is an object");
  json.begin_object();
  Edit edit;
  std::set<std::string> keys;
  while (const auto key = json.next_key()) {
    read_member(json, *key, limits, edit);
    if (!keys.insert(*key).second) refuse_edit(*key + " is given twice");
  }
  json.end();
  check_members(keys, edit);
  return edit;
}

double number_in(std::string_view text, const char* what) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() ||
      !cdt::Triangulation::is_usable(value))
    refuse_edit(std::string(what) + " is no usable number");
  return value;
}

}  // namespace

Edit read_edit(std::string_view text, const EditLimits& limits) {
  JsonReader json(text, "edit");
  try {
    return read_object(json, limits);
  } catch (const io::JsonError& error) {
    throw Refusal(400, io::one_line(error.what()));
  }
}

Question read_question(std::string what, std::string_view id, std::string_view at) {
  Question question{.what = std::move(what)};
  if (!id.empty()) question.id = id_of(number_in(id, "id"));
  if (at.empty()) return question;
  const std::size_t comma = at.find(',');
  if (comma == std::string_view::npos) refuse_edit("at is x,y");
  question.at = {number_in(at.substr(0, comma), "x"), number_in(at.substr(comma + 1), "y")};
  return question;
}

}  // namespace loft::app
