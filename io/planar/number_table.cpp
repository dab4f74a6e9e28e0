// SPDX-License-Identifier: MIT
#include "io/planar/number_table.h"

#include <algorithm>
#include <limits>

#include "io/bytes/text.h"
#include "io/bytes/words.h"
#include "io/planar/coordinate.h"

namespace loft::io {

NumberTable::NumberTable(std::string_view text, std::string_view name) : rows_(text), name_(name) {
  for (const std::string& one : rows_.names()) names_.push_back(in_lower_case(one));
}

std::optional<std::size_t> NumberTable::column(std::string_view name) const {
  const auto found = std::ranges::find(names_, name);
  if (found == names_.end()) return {};
  return static_cast<std::size_t>(found - names_.begin());
}

bool NumberTable::next_row() {
  if (rows_.next()) return true;
  if (rows_.ends_in_quotes()) complain("a quotation mark has no mate; double those inside a text");
  return false;
}

std::optional<double> NumberTable::number(std::size_t column, const std::string& what) {
  const auto value = csv_number(cell(column), rows_.style());
  if (value) return value;
  complain(is_empty(column)
               ? what + " is missing"
               : "expected a number for " + what + ", found " + in_quotes(cell(column)));
  return {};
}

std::optional<double> NumberTable::finite(std::size_t column, const std::string& what) {
  const auto value = number(column, what);
  constexpr Range any{0, std::numeric_limits<double>::max()};
  if (!value || any.admits(*value)) return value;
  complain(what + ": " + why_not_admitted(*value, any));
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
  problems_.add(std::string(name_) + ':' + std::to_string(rows_.line()) + ": " + problem);
}

}  // namespace loft::io
