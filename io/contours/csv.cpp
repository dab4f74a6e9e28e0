// SPDX-License-Identifier: MIT
#include "io/contours/csv.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "io/bytes/csv_columns.h"
#include "io/bytes/problems.h"
#include "io/bytes/text.h"
#include "io/bytes/utf8.h"
#include "io/bytes/words.h"
#include "io/contours/heights.h"
#include "io/contours/stack_builder.h"
#include "mesh/admitted.h"
#include "reconstruct/usable.h"

namespace loft::io {

namespace {

/// A line of the table. `group` counts blank lines before it.
struct Row {
  cdt::Point point;
  double z = 0;
  std::string_view contour;
  std::string_view label;
  std::size_t group = 0;
  std::size_t line = 0;
};

class CsvReader {
 public:
  CsvReader(std::string_view text, std::string_view name)
      : text_(without_mark(text)), name_(name) {}

  Stack read() {
    read_head();
    while (next_line()) read_row();
    problems_.raise(name_);
    return to_stack();
  }

 private:
  void complain(const std::string& problem) {
    problems_.add(std::string(name_) + ':' + std::to_string(number_) + ": " + problem);
  }

  /// Goes to the next line that has something; counts blank ones.
  bool next_line() {
    while (place_ < text_.size()) {
      const std::size_t end = std::min(text_.find('\n', place_), text_.size());
      line_ = text_.substr(place_, end - place_);
      if (line_.ends_with('\r')) line_.remove_suffix(1);
      place_ = std::min(end + 1, text_.size());
      ++number_;
      if (without_blanks(line_).empty()) {
        ++group_;
      } else if (!line_.starts_with('#')) {
        return true;
      }
    }
    return false;
  }

  /// The first line, which may be a comment, names the columns; or it is the first point.
  void read_head() {
    const auto whole = std::pair(place_, number_);
    const std::string_view first = text_.substr(0, std::min(text_.find('\n'), text_.size()));
    std::string_view comment;
    if (first.starts_with('#'))
      comment = first.substr(std::min(first.find_first_not_of("# \t"), first.size()));
    if (!next_line()) throw InputError(std::string(name_) + ": no point in it");
    const std::string_view line = line_;
    style_ = find_csv_style("", line);
    if (is_header(line)) {
      const auto behind = std::pair(place_, number_);
      const std::string second(next_line() ? line_ : std::string_view());
      style_ = find_csv_style(line, second);
      std::tie(place_, number_) = behind;
      group_ = 0;
      return take_header(line, csv_cells(second, style_).size());
    }
    const std::size_t number = number_;
    std::tie(place_, number_) = whole;
    group_ = 0;
    if (!comment.empty() && !without_blanks(comment).empty()) {
      const CsvStyle style = find_csv_style(comment, line);
      if (const CsvHeader header = read_csv_header(csv_cells(comment, style)); has_place(header)) {
        header_ = header;
        return;
      }
    }
    take_order(csv_cells(line, style_).size(), number);
  }

  static bool has_place(const CsvHeader& header) {
    return header.of(CsvColumn::x) && header.of(CsvColumn::y) && header.of(CsvColumn::z);
  }

  /// Points have a number first; or, by the columns' order, a label.
  [[nodiscard]] bool is_header(std::string_view line) const {
    return std::ranges::none_of(csv_cells(line, style_), [&](std::string_view cell) {
      return csv_number(cell, style_).has_value();
    });
  }

  /// `columns` are those of the first point: where there is one more, it is a name of the line that
  /// the header does not count, as R writes it.
  void take_header(std::string_view line, std::size_t columns) {
    const std::vector<std::string_view> cells = csv_cells(line, style_);
    header_ = read_csv_header(cells);
    if (columns == cells.size() + 1)
      for (auto& place : header_.place)
        if (place) ++*place;
    if (has_place(header_)) return;
    std::string missing;
    for (const auto& [column, name] :
         {std::pair(CsvColumn::x, "x"), std::pair(CsvColumn::y, "y"), std::pair(CsvColumn::z, "z")})
      if (!header_.of(column)) missing += (missing.empty() ? "'" : ", '") + std::string(name) + "'";
    throw InputError(std::string(name_) + ":" + std::to_string(number_) + ": no column " + missing +
                     " in the header " + in_quotes(line) +
                     "; name the columns x, y, z and, if there are, contour, label");
  }

  /// No header: x y z contour label.
  void take_order(std::size_t columns, std::size_t line) {
    if (columns < 3)
      throw InputError(std::string(name_) + ":" + std::to_string(line) +
                       ": expected columns x y z [contour] [label], found " +
                       counted(columns, "column") +
                       "; parted by tabs, semicolons, commas or blanks");
    for (std::size_t i = 0; i < std::min(columns, csv_columns); ++i) header_.place[i] = i;
    has_header_ = false;
  }

  void read_row() {
    cells_ = csv_cells(line_, style_);
    Row row{{number(CsvColumn::x, "x"), number(CsvColumn::y, "y")},
            number(CsvColumn::z, "z"),
            cell(CsvColumn::contour),
            cell(CsvColumn::label),
            group_,
            number_};
    rows_.push_back(row);
  }

  [[nodiscard]] std::string_view cell(CsvColumn column) const {
    const auto place = header_.of(column);
    return place && *place < cells_.size() ? cells_[*place] : std::string_view();
  }

  double number(CsvColumn column, const char* name) {
    const std::string_view text = cell(column);
    const auto value = csv_number(text, style_);
    if (value && admitted::slice.admits(*value)) return *value;
    if (value) {
      complain(std::string(name) + ": " + why_not_admitted(*value, admitted::slice) +
               "; contours are parted by blank lines");
    } else if (text.empty()) {
      complain(std::string(name) + " is missing; the line has " + counted(cells_.size(), "column"));
    } else {
      complain(std::string("expected a number for ") + name + ", found " + in_quotes(text));
    }
    return 0;
  }

  Stack to_stack() {
    std::vector<double> heights;
    heights.reserve(rows_.size());
    for (const Row& row : rows_) heights.push_back(row.z);
    const HeightGroups groups(std::move(heights));
    StackBuilder builder(name_);
    const bool has_ids = header_.of(CsvColumn::contour).has_value();
    for (std::size_t begin = 0; begin < rows_.size();) {
      const Row& first = rows_[begin];
      const double z = groups.of(first.z);
      std::size_t end = begin;
      Contour contour{
          {}, json_text(std::string(first.label)), "line " + std::to_string(first.line)};
      while (end < rows_.size() && rows_[end].contour == first.contour &&
             rows_[end].label == first.label && groups.of(rows_[end].z) == z &&
             (has_ids || rows_[end].group == first.group))
        contour.points.push_back(rows_[end++].point);
      builder.add(std::move(contour), z);
      begin = end;
    }
    Stack stack;
    stack.unit = json_text(one_line(header_.unit));
    if (!has_header_)
      stack.notes.push_back("no header: the columns were taken as x y z contour label, in order");
    builder.finish(stack,
                   "a contour has three points or more, one a line, with the same z; blank "
                   "lines part contours");
    return stack;
  }

  std::string_view text_;
  std::string_view name_;
  Problems problems_;
  CsvStyle style_;
  CsvHeader header_;
  bool has_header_ = true;
  std::string_view line_;
  std::size_t place_ = 0;
  std::size_t number_ = 0;
  std::size_t group_ = 0;
  std::vector<std::string_view> cells_;
  std::vector<Row> rows_;
};

}  // namespace

Stack read_csv(const StackInput& input, const ReadOptions&) {
  return CsvReader(input.bytes, input.name).read();
}

}  // namespace loft::io
