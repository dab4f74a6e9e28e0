// SPDX-License-Identifier: MIT
#include "io/stacks/slice_line.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "io/bytes/json_reader.h"
#include "io/bytes/near_word.h"
#include "io/bytes/text.h"
#include "io/stacks/edit.h"

namespace loft::io {

namespace {

/// What a line may be.
enum class Content { slice, edit };

class LineReader {
 public:
  LineReader(std::string_view text, Content content) : json_(text), content_(content) {}

  EditLine read() {
    try {
      read_slice();
    } catch (const JsonError& error) {
      complain("broken JSON at column " + std::to_string(error.column()) + ": " + error.what());
    }
    return std::move(line_);
  }

 private:
  /// A line can be wrong in as many places as it has bytes: the first ones are told.
  void complain(const std::string& problem) {
    constexpr std::size_t most = 10'000;
    if (line_.problems.size() < most) line_.problems.push_back(problem);
    if (line_.problems.size() == most) line_.problems.back() = "and more that is not listed";
  }

  /// Leaves out the value that comes next and says what should have been there.
  void reject(const std::string& place, const std::string& wanted) {
    complain(place + loft::io::reject(json_, wanted));
  }

  void read_slice() {
    const std::string wanted = "a slice {\"z\": ..., \"contours\": [...]}";
    if (json_.peek() != JsonKind::object) return reject("", wanted);
    json_.begin_object();
    while (const auto key = json_.next_key()) read_member(*key);
    json_.end("; one slice a line");
    check_members();
  }

  void read_member(const std::string& key) {
    keys_.note(key);
    if (key == "z") {
      line_.z = read_number([] { return std::string("\"z\": "); }, "a finite number");
      line_.edit.slice.z = line_.z.value_or(0);
    } else if (key == "contours") {
      read_contours();
    } else if (key == "labels") {
      has_labels_ = true;
      read_texts(labels_, "label", "\"labels\": ");
    } else if (key == "sources") {
      has_sources_ = true;
      read_texts(sources_, "source", "\"sources\": ");
    } else if (key == "places") {
      has_places_ = true;
      read_places();
    } else if (key == "op") {
      read_op();
    } else {
      json_.skip();
    }
  }

  /// A finite number, or none and a complaint. `place` makes the text that says where.
  template <class Place>
  std::optional<double> read_number(const Place& place, const char* wanted) {
    if (json_.peek() != JsonKind::number) {
      reject(place(), wanted);
      return std::nullopt;
    }
    const double value = json_.number();
    if (std::isfinite(value)) return value;
    const std::string word(json_.last_word());
    complain(place() + word + " is too large for a number; write " + wanted);
    return std::nullopt;
  }

  void read_op() {
    if (json_.peek() != JsonKind::string) return reject("\"op\": ", "\"insert\"");
    const std::string op = json_.string();
    const bool is_edit = op == "replace" || op == "remove";
    if (is_edit && content_ == Content::edit) {
      line_.edit.kind = op == "replace" ? Edit::Kind::replace : Edit::Kind::remove;
    } else if (is_edit) {
      complain("\"op\": \"" + op + "\" is an edit; a stack holds its slices only, without \"op\"");
    } else if (op != "insert") {
      complain("\"op\": " + in_quotes(op) +
               (content_ == Content::edit
                    ? " is unknown; write \"insert\", \"replace\" or \"remove\""
                    : " is unknown; leave \"op\" out"));
    }
  }

  void read_texts(std::vector<std::string>& texts, const std::string& one,
                  const std::string& place) {
    texts.clear();
    if (json_.peek() != JsonKind::list) return reject(place, "a list of names");
    json_.begin_list();
    while (json_.next_item()) {
      const bool is_name = json_.peek() == JsonKind::string;
      if (!is_name) reject(one + ' ' + std::to_string(texts.size()) + ": ", "a name in quotes");
      texts.push_back(is_name ? json_.string() : std::string());
    }
  }

  void read_places() {
    places_.clear();
    if (json_.peek() != JsonKind::list) return reject("\"places\": ", "a list of lists of places");
    json_.begin_list();
    while (json_.next_item()) {
      auto& places = places_.emplace_back();
      const std::string place = "places of contour " + std::to_string(places_.size() - 1) + ": ";
      if (json_.peek() != JsonKind::list) {
        reject(place, "a list of places");
        continue;
      }
      json_.begin_list();
      while (json_.next_item()) {
        if (json_.peek() == JsonKind::list) {
          places.push_back(read_coordinates<3>([&] { return place; }, "a place [x, y, z]"));
        } else {
          reject(place, "a place [x, y, z]");
        }
      }
    }
  }

  void read_contours() {
    line_.edit.slice.contours.clear();
    if (json_.peek() != JsonKind::list) return reject("\"contours\": ", "a list of contours");
    json_.begin_list();
    while (json_.next_item()) {
      line_.edit.slice.contours.emplace_back();
      read_contour(line_.edit.slice.contours.back());
    }
  }

  [[nodiscard]] std::string contour_place() const {
    return "contour " + std::to_string(line_.edit.slice.contours.size() - 1) + ' ';
  }

  [[nodiscard]] std::string point_place() const {
    const std::size_t point = line_.edit.slice.contours.back().points.size();
    return contour_place() + "point " + std::to_string(point) + ": ";
  }

  void read_contour(Contour& contour) {
    if (json_.peek() != JsonKind::list) return reject(contour_place(), "a list of points");
    json_.begin_list();
    // A bad point keeps its place, so that the numbers of those behind it are right.
    while (json_.next_item()) contour.points.push_back(read_point());
  }

  cdt::Point read_point() {
    if (json_.peek() != JsonKind::list) {
      reject(point_place(), "a point [x, y]");
      return {};
    }
    const auto [x, y] = read_coordinates<2>([this] { return point_place(); }, "[x, y]");
    return {x, y};
  }

  /// Precondition: a list comes next.
  template <std::size_t Count, class Place>
  std::array<double, Count> read_coordinates(const Place& place, const char* wanted) {
    std::array<double, Count> coordinates{};
    std::size_t count = 0;
    json_.begin_list();
    for (; json_.next_item(); ++count) {
      const auto value = read_number(place, "a finite number or leave the point out");
      if (count < Count) coordinates[count] = value.value_or(0);
    }
    if (count != Count)
      complain(place() + "has " + std::to_string(count) + " coordinates instead of " + wanted);
    return coordinates;
  }

  /// What only the whole line can tell.
  void check_members() {
    std::vector<Contour>& contours = line_.edit.slice.contours;
    for (const std::string& problem : keys_.misspelt()) complain(problem);
    if (keys_.lacks("z")) complain("\"z\" is missing; a slice needs its height");
    if (line_.edit.kind == Edit::Kind::remove) {
      contours.clear();
      return;
    }
    if (keys_.lacks("contours"))
      complain("\"contours\" is missing; an empty slice has \"contours\": []");
    if (has_labels_ && labels_.size() != contours.size()) {
      return complain(std::to_string(labels_.size()) + " labels for " +
                      std::to_string(contours.size()) + " contours; each contour needs one");
    }
    for (std::size_t i = 0; i < labels_.size(); ++i) contours[i].label = std::move(labels_[i]);
    take_sources(contours);
    take_places(contours);
  }

  void take_sources(std::vector<Contour>& contours) {
    if (has_sources_ && sources_.size() != contours.size())
      return complain(std::to_string(sources_.size()) + " sources for " +
                      std::to_string(contours.size()) + " contours; each contour needs one");
    for (std::size_t i = 0; i < sources_.size(); ++i) contours[i].source = std::move(sources_[i]);
  }

  void take_places(std::vector<Contour>& contours) {
    if (has_places_ && places_.size() != contours.size())
      return complain("places of " + std::to_string(places_.size()) + " contours instead of " +
                      std::to_string(contours.size()));
    for (std::size_t i = 0; i < places_.size(); ++i) {
      if (!places_[i].empty() && places_[i].size() != contours[i].points.size())
        complain("contour " + std::to_string(i) + " has " + std::to_string(places_[i].size()) +
                 " places for " + std::to_string(contours[i].points.size()) + " points");
      contours[i].places = std::move(places_[i]);
    }
  }

  JsonReader json_;
  Content content_;
  EditLine line_;
  std::vector<std::string> labels_;
  std::vector<std::string> sources_;
  std::vector<std::vector<std::array<double, 3>>> places_;
  KeyWatch keys_{"z", "contours", "labels", "sources", "places", "op"};
  bool has_labels_ = false;
  bool has_sources_ = false;
  bool has_places_ = false;
};

}  // namespace

SliceLine parse_slice_line(std::string_view line) {
  EditLine read = LineReader(line, Content::slice).read();
  return {std::move(read.edit.slice), std::move(read.problems), read.z};
}

EditLine parse_edit_line(std::string_view line) { return LineReader(line, Content::edit).read(); }

}  // namespace loft::io
