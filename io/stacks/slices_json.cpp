// SPDX-License-Identifier: MIT
#include "io/stacks/slices_json.h"

#include <algorithm>
#include <cstddef>
#include <sstream>
#include <string>
#include <utility>

#include "io/bytes/file.h"
#include "io/bytes/json_reader.h"
#include "io/bytes/problems.h"
#include "io/bytes/text.h"
#include "io/bytes/words.h"
#include "io/stacks/edit.h"
#include "io/stacks/slice_line.h"
#include "io/stacks/slice_lines.h"
#include "io/stacks/stack_line.h"
#include "reconstruct/defect.h"
#include "reconstruct/number_text.h"
#include "reconstruct/parallel.h"

namespace loft::io {

namespace {

struct NumberedLine {
  std::string text;
  std::size_t number = 0;  // in the file, from 1
  LinePlace place;
};

/// `stack.ndjson:3: slice 2 (z = 2.5) `
std::string place(std::string_view name, std::size_t line, std::size_t slice,
                  const SliceLine& parsed) {
  std::string result(name);
  result += ':' + std::to_string(line) + ": slice " + std::to_string(slice);
  if (parsed.z) {
    result += " (z = ";
    append_number(result, *parsed.z);
    result += ')';
  }
  return result + ' ';
}

}  // namespace

namespace {

/// Reads lines with something in them, as many as make it worth to share them out.
class Batches {
 public:
  explicit Batches(std::istream& in) : in_(in) {}

  /// The next lines; none at the end.
  [[nodiscard]] std::span<const NumberedLine> next() {
    std::size_t size = 0;
    std::size_t count = 0;
    while (size < batch_size) {
      if (count == lines_.size()) lines_.emplace_back();
      NumberedLine& line = lines_[count];
      if (!std::getline(in_, line.text)) break;
      line.number = ++number_;
      line.place = {offset_, line.text.size()};
      offset_ += line.text.size() + 1;
      if (number_ == 1) line.text = without_mark(line.text);
      if (without_blanks(line.text).empty()) continue;
      size += line.text.size();
      ++count;
    }
    return std::span(lines_).first(count);
  }

 private:
  static constexpr std::size_t batch_size = std::size_t{1} << 20U;

  std::istream& in_;
  std::size_t number_ = 0;
  std::uint64_t offset_ = 0;
  std::vector<NumberedLine> lines_;  // their memory is used again
};

/// Whether a line tells of the whole stack.
bool take_stack_line(const NumberedLine& line, std::string_view name, Stack& about,
                     Problems& problems) {
  auto parsed = parse_stack_line(line.text);
  if (!parsed) return false;
  for (const std::string& problem : parsed->problems)
    problems.add(std::string(name) + ':' + std::to_string(line.number) + ": " + problem);
  about = std::move(parsed->stack);
  return true;
}

}  // namespace

Stack for_each_slice(std::istream& in, std::string_view name, unsigned threads,
                     const std::function<void(Slice&& slice, LinePlace place)>& take) {
  Problems problems;
  Stack about;
  Batches batches(in);
  std::size_t count = 0;
  bool is_first = true;
  for (auto lines = batches.next(); !lines.empty(); lines = batches.next()) {
    if (std::exchange(is_first, false) && take_stack_line(lines.front(), name, about, problems))
      lines = lines.subspan(1);
    std::vector<SliceLine> parsed(lines.size());
    for_each_index(lines.size(), threads,
                   [&](std::size_t i, unsigned) { parsed[i] = parse_slice_line(lines[i].text); });
    for (std::size_t i = 0; i < lines.size(); ++i, ++count) {
      for (const std::string& problem : parsed[i].problems)
        problems.add(place(name, lines[i].number, count, parsed[i]) + problem);
      take(std::move(parsed[i].slice), lines[i].place);
    }
  }
  if (in.bad()) throw FileError(Access::read, std::filesystem::path(name), "read failed");
  problems.raise(name);
  if (count == 0) {
    throw InputError(std::string(name) +
                     ": no slices in it; expected lines {\"z\": ..., \"contours\": [...]}");
  }
  return about;
}

Stack read_stack_json(std::istream& in, std::string_view name, unsigned threads) {
  std::vector<Slice> slices;
  Stack stack = for_each_slice(
      in, name, threads, [&](Slice&& slice, LinePlace) { slices.push_back(std::move(slice)); });
  stack.slices = std::move(slices);
  return stack;
}

Stack read_ndjson(const StackInput& input, const ReadOptions& options) {
  std::istringstream in{std::string(input.bytes)};
  return read_stack_json(in, input.name, options.threads);
}

std::vector<Slice> read_slices_json(std::istream& in, std::string_view name, unsigned threads) {
  return read_stack_json(in, name, threads).slices;
}

namespace {

void append_points(std::string& text, std::span<const cdt::Point> points) {
  text += '[';
  for (std::size_t i = 0; i < points.size(); ++i) {
    text += i == 0 ? "[" : ",[";
    append_number(text, points[i].x);
    text += ',';
    append_number(text, points[i].y);
    text += ']';
  }
  text += ']';
}

void append_texts(std::string& text, std::string_view key, std::span<const Contour> contours,
                  std::string Contour::*member) {
  if (std::ranges::all_of(contours, [&](const Contour& c) { return (c.*member).empty(); })) return;
  text += ",\"";
  text += key;
  text += "\":[";
  for (std::size_t i = 0; i < contours.size(); ++i) {
    if (i > 0) text += ',';
    append_json_string(text, contours[i].*member);
  }
  text += ']';
}

void append_places(std::string& text, std::span<const Contour> contours) {
  if (std::ranges::all_of(contours, [](const Contour& c) { return c.places.empty(); })) return;
  text += ",\"places\":";
  for (std::size_t i = 0; i < contours.size(); ++i) {
    text += i == 0 ? "[[" : ",[";
    for (std::size_t k = 0; k < contours[i].places.size(); ++k) {
      const auto& [x, y, z] = contours[i].places[k];
      text += k == 0 ? "[" : ",[";
      append_number(text, x);
      text += ',';
      append_number(text, y);
      text += ',';
      append_number(text, z);
      text += ']';
    }
    text += ']';
  }
  text += ']';
}

}  // namespace

void append_slice(std::string& line, const Slice& slice) {
  line += "{\"z\":";
  append_number(line, slice.z);
  line += ",\"contours\":[";
  for (std::size_t i = 0; i < slice.contours.size(); ++i) {
    if (i > 0) line += ',';
    append_points(line, slice.contours[i].points);
  }
  line += ']';
  append_texts(line, "labels", slice.contours, &Contour::label);
  append_texts(line, "sources", slice.contours, &Contour::source);
  append_places(line, slice.contours);
  line += '}';
}

void write_slices_json(std::ostream& out, std::span<const Slice> slices) {
  for (const Slice& slice : slices) {
    std::string line;
    append_slice(line, slice);
    line += '\n';
    out << line;
  }
}

void write_stack_json(std::ostream& out, const Stack& stack) {
  std::string line;
  if (append_stack_line(line, stack)) out << line << '\n';
  write_slices_json(out, stack.slices);
}

const char* name(Edit::Kind kind) {
  switch (kind) {
    case Edit::Kind::insert:
      return "insert";
    case Edit::Kind::replace:
      return "replace";
    case Edit::Kind::remove:
      break;
  }
  return "remove";
}

std::string to_line(const Edit& edit) {
  std::string line;
  if (edit.kind == Edit::Kind::remove) {
    line = "{\"op\":\"remove\",\"z\":";
    append_number(line, edit.slice.z);
    return line + '}';
  }
  append_slice(line, edit.slice);
  if (edit.kind == Edit::Kind::replace) line.insert(1, "\"op\":\"replace\",");
  return line;
}

}  // namespace loft::io
