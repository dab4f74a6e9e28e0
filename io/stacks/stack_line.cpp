// SPDX-License-Identifier: MIT
#include "io/stacks/stack_line.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>

#include "io/bytes/hexadecimal.h"
#include "io/bytes/json_reader.h"
#include "io/bytes/near_word.h"
#include "io/bytes/text.h"
#include "io/bytes/utf8.h"
#include "mesh/admitted.h"
#include "reconstruct/number_text.h"

namespace loft::io {

namespace {

struct FillName {
  std::string_view name;
  Fill fill;
};
constexpr std::array fill_names{FillName{"evenodd", Fill::even_odd},
                                FillName{"nonzero", Fill::nonzero},
                                FillName{"keyhole-aware", Fill::keyhole_aware}};

class StackLineReader {
 public:
  explicit StackLineReader(std::string_view text) : json_(text) {}

  std::optional<StackLine> read() {
    try {
      if (!find_stack()) return {};
      read_stack();
      while (json_.next_key()) json_.skip();
      json_.end();
    } catch (const JsonError& error) {
      if (!is_stack_) return {};  // whoever reads slices complains
      complain("broken JSON at column " + std::to_string(error.column()) + ": " + error.what());
    }
    return std::move(line_);
  }

 private:
  void complain(const std::string& problem) {
    constexpr std::size_t most = 1'000;
    if (line_.problems.size() < most) line_.problems.push_back(problem);
  }
  void reject(const std::string& place, const std::string& wanted) {
    complain(place + ": " + loft::io::reject(json_, wanted));
  }

  bool find_stack() {
    if (json_.peek() != JsonKind::object) return false;
    json_.begin_object();
    while (const auto key = json_.next_key()) {
      is_stack_ = *key == "stack";
      if (is_stack_) return true;
      json_.skip();
    }
    return false;
  }

  void read_stack() {
    if (json_.peek() != JsonKind::object) return reject("\"stack\"", "an object {\"unit\": ...}");
    KeyWatch keys{"unit", "frame", "fill", "keyhole_width", "gap", "labels", "notes"};
    json_.begin_object();
    while (const auto key = json_.next_key()) {
      keys.note(*key);
      read_member(*key);
    }
    for (const std::string& problem : keys.misspelt()) complain(problem);
  }

  void read_member(const std::string& key) {
    if (key == "unit") {
      line_.stack.unit = text("\"unit\"", "a name such as \"mm\"");
    } else if (key == "frame") {
      read_frame();
    } else if (key == "fill") {
      read_fill();
    } else if (key == "keyhole_width") {
      line_.stack.keyhole_width = length("\"keyhole_width\"");
    } else if (key == "gap") {
      line_.stack.gap = length("\"gap\"");
    } else if (key == "labels") {
      read_labels();
    } else if (key == "notes") {
      for_each_item("\"notes\"", [&] { line_.stack.notes.push_back(text("a note", "a text")); });
    } else {
      json_.skip();
    }
  }

  std::string text(const std::string& place, const std::string& wanted) {
    if (json_.peek() == JsonKind::string) return json_.string();
    reject(place, wanted);
    return {};
  }
  std::optional<double> number(const std::string& place, const std::string& wanted) {
    if (json_.peek() != JsonKind::number) {
      reject(place, wanted);
      return {};
    }
    const double value = json_.number();
    if (std::isfinite(value)) return value;
    complain(place + ": is too large for a number");
    return {};
  }
  std::optional<double> length(const std::string& place) {
    const auto value = number(place, "a length");
    if (!value || admitted::length.admits_length(*value)) return value;
    complain(place + ": a length is 0 or from 1e-30 to 1e70");
    return {};
  }

  template <class Take>
  void for_each_item(const std::string& place, const Take& take) {
    if (json_.peek() != JsonKind::list) return reject(place, "a list");
    json_.begin_list();
    while (json_.next_item()) take();
  }

  void read_frame() {
    std::vector<double> numbers;
    const std::string wanted = "16 numbers, row by row";
    for_each_item("\"frame\"", [&] {
      const auto value = number("\"frame\"", wanted);
      if (numbers.size() <= 16) numbers.push_back(value.value_or(0));
    });
    if (numbers.size() != 16) return complain("\"frame\": a matrix has " + wanted);
    WorldFrame frame;
    for (std::size_t i = 0; i < 16; ++i) frame.rows[i / 4][i % 4] = numbers[i];
    if (const std::string wrong = fault(frame); !wrong.empty())
      return complain("\"frame\": " + wrong);
    line_.stack.frame = frame;
  }

  void read_fill() {
    const std::string word = text("\"fill\"", "a rule");
    const auto found = std::ranges::find(fill_names, word, &FillName::name);
    if (found != fill_names.end()) {
      line_.stack.fill = found->fill;
    } else {
      complain("\"fill\": " + in_quotes(word) +
               " is unknown; write \"evenodd\", \"nonzero\" or \"keyhole-aware\"");
    }
  }

  void read_labels() {
    for_each_item("\"labels\"", [&] {
      if (json_.peek() != JsonKind::object) return reject("a label", "{\"name\": ...}");
      line_.stack.labels.push_back(read_label());
    });
  }

  StackLabel read_label() {
    StackLabel label;
    KeyWatch keys{"name", "colour", "id", "kind", "gap"};
    json_.begin_object();
    while (const auto key = json_.next_key()) {
      keys.note(*key);
      if (*key == "name") {
        label.name = text("\"name\"", "a name");
      } else if (*key == "colour") {
        const std::string colour = text("\"colour\"", "a colour \"#rrggbb\"");
        label.colour = to_colour(colour);
        if (!label.colour)
          complain("\"colour\": " + in_quotes(colour) + " is none; write \"#rrggbb\"");
      } else if (*key == "id") {
        label.id = text("\"id\"", "a text");
      } else if (*key == "kind") {
        label.kind = text("\"kind\"", "a text");
      } else if (*key == "gap") {
        label.gap = length("\"gap\" of a label");
      } else {
        json_.skip();
      }
    }
    for (const std::string& problem : keys.misspelt()) complain(problem);
    if (keys.lacks("name")) complain("\"name\" of a label is missing");
    return label;
  }

  JsonReader json_;
  StackLine line_;
  bool is_stack_ = false;
};

void append_member(std::string& line, const char* key) {
  if (line.back() != '{') line += ',';
  line += '"';
  line += key;
  line += "\":";
}

void append_text(std::string& line, const char* key, const std::string& text) {
  if (text.empty()) return;
  append_member(line, key);
  append_json_string(line, json_text(text));
}

void append_length(std::string& line, const char* key, std::optional<double> length) {
  if (!length) return;
  append_member(line, key);
  append_number(line, *length);
}

void append_label(std::string& line, const StackLabel& label) {
  line += "{\"name\":";
  append_json_string(line, json_text(label.name));
  if (label.colour) append_text(line, "colour", to_text(*label.colour));
  append_text(line, "id", label.id);
  append_text(line, "kind", label.kind);
  append_length(line, "gap", label.gap);
  line += '}';
}

template <class List, class Append>
void append_list(std::string& line, const char* key, const List& list, const Append& append) {
  if (list.empty()) return;
  append_member(line, key);
  for (std::size_t i = 0; i < list.size(); ++i) {
    line += i == 0 ? '[' : ',';
    append(line, list[i]);
  }
  line += ']';
}

}  // namespace

bool begins_like_stack_line(std::string_view line) {
  constexpr std::string_view key = "\"stack\"";
  const auto skip = [&line] {
    line.remove_prefix(std::min(line.find_first_not_of(" \t\r"), line.size()));
  };
  line = without_mark(line);
  skip();
  if (!line.starts_with('{')) return false;
  line.remove_prefix(1);
  skip();
  return line.starts_with(key);
}

std::optional<StackLine> parse_stack_line(std::string_view line) {
  return StackLineReader(line).read();
}

bool append_stack_line(std::string& line, const Stack& stack) {
  std::string about = "{";
  append_text(about, "unit", stack.unit);
  if (stack.frame) {
    append_member(about, "frame");
    for (std::size_t i = 0; i < 16; ++i) {
      about += i == 0 ? '[' : ',';
      append_number(about, stack.frame->rows[i / 4][i % 4]);
    }
    about += ']';
  }
  if (stack.fill) {
    const auto found = std::ranges::find(fill_names, *stack.fill, &FillName::fill);
    append_text(about, "fill", std::string(found->name));
  }
  append_length(about, "keyhole_width", stack.keyhole_width);
  append_length(about, "gap", stack.gap);
  append_list(about, "labels", stack.labels, append_label);
  append_list(about, "notes", stack.notes, [](std::string& text, const std::string& note) {
    append_json_string(text, json_text(note));
  });
  if (about == "{") return false;
  line += "{\"stack\":" + about + "}}";
  return true;
}

std::string to_text(Colour colour) { return hexadecimal(colour); }

std::optional<Colour> to_colour(std::string_view text) {
  if (text.size() != 7 || text[0] != '#') return {};
  std::array<std::uint8_t, 3> parts{};
  for (std::size_t i = 0; i < 3; ++i) {
    const char* const begin = text.data() + 1 + 2 * i;
    const auto [end, error] = std::from_chars(begin, begin + 2, parts[i], 16);
    if (error != std::errc() || end != begin + 2) return {};
  }
  return Colour{parts[0], parts[1], parts[2]};
}

}  // namespace loft::io
