// SPDX-License-Identifier: MIT
#include "io/planar/scene_edits.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "io/bytes/json_reader.h"
#include "io/bytes/near_word.h"
#include "io/bytes/problems.h"
#include "io/bytes/text.h"
#include "io/bytes/words.h"
#include "io/planar/coordinate.h"

namespace loft::io {

namespace {

using cdt::Point;

/// One line.
class EditReader {
 public:
  EditReader(std::string_view text, std::string place, Problems& problems)
      : json_(text), problems_(problems) {
    edit_.place = std::move(place);
  }

  SceneEdit read() {
    try {
      read_edit();
    } catch (const JsonError& error) {
      complain("broken JSON at column " + std::to_string(error.column()) + ": " + error.what());
    }
    return std::move(edit_);
  }

 private:
  static constexpr const char* wanted_edit =
      R"(an edit {"move": ..., "by": [dx, dy]}, {"ring": ..., "points": [...]}, )"
      R"({"remove": ...} or {"insert": {"points": [...]}})";

  void complain(const std::string& problem) { problems_.add(edit_.place + ": " + problem); }
  void refuse(const std::string& where, const std::string& wanted) {
    complain(where + reject(json_, wanted));
  }

  void read_edit() {
    if (json_.peek() != JsonKind::object) return refuse("", wanted_edit);
    KeyWatch keys{"move", "by", "ring", "points", "remove", "insert"};
    json_.begin_object();
    while (const auto key = json_.next_key()) {
      keys.note(*key);
      read_member(*key);
    }
    json_.end("; one edit a line");
    const std::vector<std::string> misspelt = keys.misspelt();
    for (const std::string& problem : misspelt) complain(problem);
    if (kinds_ != 1 && misspelt.empty()) complain(std::string("expected ") + wanted_edit);
    if (edit_.kind == SceneEdit::Kind::move && keys.lacks("by"))
      complain(R"("by" is missing; write [dx, dy])");
    if (edit_.kind == SceneEdit::Kind::reshape && keys.lacks("points"))
      complain(R"("points" is missing; write [[x, y], ...])");
  }

  void read_member(const std::string& key) {
    if (key == "move") {
      begin(SceneEdit::Kind::move);
    } else if (key == "ring") {
      begin(SceneEdit::Kind::reshape);
    } else if (key == "remove") {
      begin(SceneEdit::Kind::remove);
    } else if (key == "insert") {
      ++kinds_;
      edit_.kind = SceneEdit::Kind::insert;
      read_new();
    } else if (key == "by") {
      edit_.by = read_point("\"by\": ", "[dx, dy]").value_or(Point{});
    } else if (key == "points") {
      read_points("\"points\": ");
    } else {
      json_.skip();
    }
  }

  void begin(SceneEdit::Kind kind) {
    ++kinds_;
    edit_.kind = kind;
    read_name();
  }

  void read_name() {
    const JsonKind kind = json_.peek();
    if (kind == JsonKind::string) {
      edit_.feature = json_.string();
    } else if (kind == JsonKind::number) {
      edit_.feature = json_.text();
    } else {
      refuse("", "the id or name of a feature");
    }
  }

  void read_new() {
    if (json_.peek() != JsonKind::object)
      return refuse("\"insert\": ", R"(a feature {"points": [...]} or {"line": [...]})");
    KeyWatch keys{"id", "layer", "points", "line"};
    std::size_t shapes = 0;
    json_.begin_object();
    while (const auto key = json_.next_key()) {
      keys.note(*key);
      if (*key == "id") {
        read_name();
      } else if (*key == "layer") {
        read_layer();
      } else if (*key == "points" || *key == "line") {
        ++shapes;
        edit_.ends = *key == "line" ? cdt::open : cdt::closed;
        read_points('"' + *key + "\": ");
      } else {
        json_.skip();
      }
    }
    for (const std::string& problem : keys.misspelt()) complain(problem);
    if (shapes != 1) complain(R"("insert": needs "points", a ring, or "line", one of them)");
  }

  void read_layer() {
    if (json_.peek() != JsonKind::string) return refuse("\"layer\": ", "the name of a layer");
    edit_.layer = json_.string();
  }

  void read_points(const std::string& where) {
    edit_.points.clear();
    if (json_.peek() != JsonKind::list) return refuse(where, "a list of points");
    std::size_t count = 0;
    json_.begin_list();
    for (; json_.next_item(); ++count) {
      const auto point = read_point("point " + std::to_string(count) + ": ", "[x, y]");
      if (point) edit_.points.push_back(*point);
    }
    if (count == 0) complain(where + "no point in it");
  }

  /// None, and a complaint, where it is no point.
  std::optional<Point> read_point(const std::string& where, const std::string& wanted) {
    if (json_.peek() != JsonKind::list) {
      refuse(where, wanted);
      return {};
    }
    std::vector<double> coordinates;
    std::size_t count = 0;
    json_.begin_list();
    for (; json_.next_item(); ++count)
      if (const auto value = read_coordinate(where)) coordinates.push_back(*value);
    if (count != 2)
      complain(where + "has " + std::to_string(count) + " coordinates instead of " + wanted);
    if (count != 2 || coordinates.size() != 2) return {};
    return Point{coordinates[0], coordinates[1]};
  }

  std::optional<double> read_coordinate(const std::string& where) {
    if (json_.peek() != JsonKind::number) {
      refuse(where, "a finite number");
      return {};
    }
    const double value = json_.number();
    if (is_coordinate(value)) return value;
    complain(where + why_no_coordinate(value));
    return {};
  }

  JsonReader json_;
  Problems& problems_;
  SceneEdit edit_;
  std::size_t kinds_ = 0;  // how many of the four were asked for
};

}  // namespace

std::vector<SceneEdit> read_scene_edits(std::string_view text, std::string_view name) {
  text = without_mark(text);
  std::vector<SceneEdit> edits;
  Problems problems;
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (without_blanks(line).empty()) continue;
    const std::string place = std::string(name) + ':' + std::to_string(number);
    edits.push_back(EditReader(line, place, problems).read());
  }
  problems.raise(name);
  if (edits.empty()) throw InputError(std::string(name) + ": no edits in it");
  return edits;
}

}  // namespace loft::io
