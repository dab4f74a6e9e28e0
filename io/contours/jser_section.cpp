// SPDX-License-Identifier: MIT
#include "io/contours/jser_section.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "io/bytes/text.h"
#include "mesh/admitted.h"
#include "reconstruct/usable.h"

namespace loft::io {

namespace {

/// Reads numbers until the list ends. False, after a complaint, where something is none.
bool read_numbers(JsonReader& json, std::vector<double>& numbers, const std::string& what,
                  const JserComplain& complain) {
  if (json.peek() != JsonKind::list) {
    complain(what + ": " + reject(json, "a list of numbers"));
    return false;
  }
  bool is_good = true;
  json.begin_list();
  while (json.next_item()) {
    if (json.peek() != JsonKind::number) {
      if (is_good) complain(what + ": " + reject(json, "a number"));
      if (!is_good) json.skip();
      is_good = false;
      continue;
    }
    const double value = json.number();
    if (is_good && !admitted::slice.admits(value)) {
      complain(what + ": " + why_not_admitted(value, admitted::slice));
      is_good = false;
    }
    numbers.push_back(value);
  }
  return is_good;
}

bool read_flag(JsonReader& json) {
  json.skip();
  return json.last_word() == "true" || json.last_word() == "1";
}

class TraceReader {
 public:
  TraceReader(JsonReader& json, const JserComplain& complain) : json_(json), complain_(complain) {}

  std::optional<JserTrace> read() {
    if (json_.peek() == JsonKind::list) {
      read_list();
    } else if (json_.peek() == JsonKind::object) {
      read_object();
    } else {
      complain_(reject(json_, "a trace, a list or an object"));
      return {};
    }
    if (is_good_ && trace_.x.size() != trace_.y.size()) {
      complain_("has " + std::to_string(trace_.x.size()) + " x and " +
                std::to_string(trace_.y.size()) + " y");
      is_good_ = false;
    }
    return is_good_ ? std::optional(std::move(trace_)) : std::nullopt;
  }

 private:
  /// [name (not always), x, y, colour, closed, negative, hidden, ...].
  void read_list() {
    json_.begin_list();
    for (std::size_t i = 0; json_.next_item(); ++i) {
      if (i == 0 && json_.peek() == JsonKind::string) {
        json_.skip();
        --i;
        continue;
      }
      constexpr std::array members{"x", "y", "color", "closed", "negative", "hidden"};
      read_member(i < members.size() ? members[i] : "");
    }
  }

  void read_object() {
    json_.begin_object();
    while (const auto key = json_.next_key()) read_member(*key);
  }

  void read_member(std::string_view key) {
    if (key == "x") {
      is_good_ = read_numbers(json_, trace_.x, "x", complain_) && is_good_;
    } else if (key == "y") {
      is_good_ = read_numbers(json_, trace_.y, "y", complain_) && is_good_;
    } else if (key == "color") {
      read_colour();
    } else if (key == "closed") {
      trace_.is_closed = read_flag(json_);
    } else if (key == "negative") {
      trace_.is_negative = read_flag(json_);
    } else if (key == "hidden") {
      trace_.is_hidden = read_flag(json_);
    } else {
      json_.skip();
    }
  }

  /// [red, green, blue], from 0 to 255. Whatever else it is does no harm.
  void read_colour() {
    if (json_.peek() != JsonKind::list) return json_.skip();
    std::array<std::uint8_t*, 3> parts{&trace_.colour.red, &trace_.colour.green,
                                       &trace_.colour.blue};
    json_.begin_list();
    for (std::size_t i = 0; json_.next_item(); ++i) {
      if (i >= parts.size() || json_.peek() != JsonKind::number) {
        json_.skip();
      } else {
        *parts[i] = static_cast<std::uint8_t>(std::clamp(std::round(json_.number()), 0.0, 255.0));
      }
    }
  }

  JsonReader& json_;
  const JserComplain& complain_;
  JserTrace trace_;
  bool is_good_ = true;
};

void read_alignment(JsonReader& json, const std::string& name, JserSection& section,
                    const JserComplain& complain) {
  std::vector<double> numbers;
  const std::string what = "alignment " + in_quotes(name);
  if (!read_numbers(json, numbers, what, complain)) return;
  if (numbers.size() != 6) return complain(what + ": a transform has 6 numbers");
  JserTransform transform{};
  std::ranges::copy(numbers, transform.begin());
  const double area = transform[0] * transform[4] - transform[1] * transform[3];
  if (area == 0) return complain(what + ": it leaves no area");
  section.alignments[name] = transform;
}

}  // namespace

JserSection read_jser_section(JsonReader& json, const JserComplain& complain) {
  JserSection section;
  json.begin_object();
  while (const auto key = json.next_key()) {
    if (*key == "thickness" && json.peek() == JsonKind::number) {
      section.thickness = json.number();
    } else if (*key == "tform" && json.peek() == JsonKind::list) {  // before there were several
      read_alignment(json, "default", section, complain);
    } else if (*key == "tforms" && json.peek() == JsonKind::object) {
      json.begin_object();
      while (const auto name = json.next_key()) read_alignment(json, *name, section, complain);
    } else if (*key == "contours" && json.peek() == JsonKind::object) {
      section.contours = json;
      json.skip();
    } else {
      json.skip();
    }
  }
  return section;
}

void read_jser_traces(
    JsonReader contours, const JserComplain& complain,
    const std::function<void(const std::string&, std::size_t, const JserTrace&)>& take) {
  contours.begin_object();
  while (const auto name = contours.next_key()) {
    if (contours.peek() != JsonKind::list) {
      complain(in_quotes(*name) + ": " + reject(contours, "a list of traces"));
      continue;
    }
    contours.begin_list();
    for (std::size_t i = 0; contours.next_item(); ++i) {
      const std::string place = in_quotes(*name) + " trace " + std::to_string(i) + ": ";
      const JserComplain complain_there = [&](const std::string& problem) {
        complain(place + problem);
      };
      if (const auto trace = TraceReader(contours, complain_there).read()) take(*name, i, *trace);
    }
  }
}

}  // namespace loft::io
