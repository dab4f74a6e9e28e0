// SPDX-License-Identifier: MIT
#include "io/slices_json.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>

#include "io/file.h"
#include "io/json_reader.h"
#include "io/problems.h"
#include "io/slice_line.h"
#include "io/text.h"
#include "reconstruct/defect.h"

namespace loft::io {

namespace {

bool is_blank(std::string_view line) {
  return line.find_first_not_of(" \t\r") == std::string_view::npos;
}

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

std::vector<Slice> read_slices_json(std::istream& in, std::string_view name) {
  std::vector<Slice> slices;
  Problems problems;
  std::string line;
  for (std::size_t number = 1; std::getline(in, line); ++number) {
    if (number == 1) line = without_mark(line);
    if (is_blank(line)) continue;
    SliceLine parsed = parse_slice_line(line);
    const std::string where = place(name, number, slices.size(), parsed);
    for (const std::string& problem : parsed.problems) problems.add(where + problem);
    slices.push_back(std::move(parsed.slice));
  }
  if (in.bad()) throw FileError(Access::read, std::filesystem::path(name), "read failed");
  problems.raise(name);
  if (slices.empty()) {
    throw InputError(std::string(name) +
                     ": no slices in it; expected lines {\"z\": ..., \"contours\": [...]}");
  }
  return slices;
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

void append_labels(std::string& text, std::span<const Contour> contours) {
  if (std::ranges::all_of(contours, [](const Contour& c) { return c.label.empty(); })) return;
  text += ",\"labels\":[";
  for (std::size_t i = 0; i < contours.size(); ++i) {
    if (i > 0) text += ',';
    append_json_string(text, contours[i].label);
  }
  text += ']';
}

}  // namespace

void write_slices_json(std::ostream& out, std::span<const Slice> slices) {
  for (const Slice& slice : slices) {
    std::string line = "{\"z\":";
    append_number(line, slice.z);
    line += ",\"contours\":[";
    for (std::size_t i = 0; i < slice.contours.size(); ++i) {
      if (i > 0) line += ',';
      append_points(line, slice.contours[i].points);
    }
    line += ']';
    append_labels(line, slice.contours);
    line += "}\n";
    out << line;
  }
}

}  // namespace loft::io
