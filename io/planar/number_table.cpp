// SPDX-License-Identifier: MIT
#include "io/planar/number_table.h"

#include <algorithm>
#include <utility>

#include "io/bytes/text.h"
#include "io/bytes/words.h"
#include "io/planar/coordinate.h"

namespace loft::io {

NumberTable::NumberTable(std::string_view text, std::string_view name)
    : text_(without_mark(text)), name_(name) {
  is_line_next_ = next_line();
  if (is_line_next_) read_head();
}

/// Goes to the next line that has something.
bool NumberTable::next_line() {
  while (!text_.empty()) {
    const std::size_t end = std::min(text_.find('\n'), text_.size());
    line_ = text_.substr(0, end);
    if (line_.ends_with('\r')) line_.remove_suffix(1);
    text_.remove_prefix(std::min(end + 1, text_.size()));
    ++number_;
    if (!without_blanks(line_).empty() && !line_.starts_with('#')) return true;
  }
  line_ = {};
  return false;
}

/// A first line without a number names the columns.
void NumberTable::read_head() {
  style_ = find_csv_style("", line_);
  const auto is_number = [&](auto one) { return csv_number(one, style_).has_value(); };
  if (std::ranges::any_of(csv_cells(line_, style_), is_number)) return;
  const std::string_view header = line_;
  is_line_next_ = next_line();
  style_ = find_csv_style(header, line_);
  for (const std::string_view one : csv_cells(header, style_)) names_.push_back(in_lower_case(one));
}

std::optional<std::size_t> NumberTable::column(std::string_view name) const {
  const auto found = std::ranges::find(names_, name);
  if (found == names_.end()) return {};
  return static_cast<std::size_t>(found - names_.begin());
}

bool NumberTable::next_row() {
  if (!std::exchange(is_line_next_, false) && !next_line()) return false;
  cells_ = csv_cells(line_, style_);
  return true;
}

std::optional<double> NumberTable::number(std::size_t column, const std::string& what) {
  const auto value = csv_number(cell(column), style_);
  if (value) return value;
  complain(is_empty(column)
               ? what + " is missing"
               : "expected a number for " + what + ", found " + in_quotes(cell(column)));
  return {};
}

std::optional<double> NumberTable::coordinate(std::size_t column, const std::string& what) {
  const auto value = number(column, what);
  if (!value || is_coordinate(*value)) return value;
  complain(what + ": " + why_no_coordinate(*value));
  return {};
}

std::optional<double> NumberTable::length(std::size_t column, const std::string& what) {
  const auto value = number(column, what);
  if (!value || admitted::length.admits_length(*value)) return value;
  complain(what + ": " + why_not_admitted(*value, admitted::length));
  return {};
}

void NumberTable::complain(const std::string& problem) {
  problems_.add(std::string(name_) + ':' + std::to_string(number_) + ": " + problem);
}

}  // namespace loft::io
