// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/bytes/csv_columns.h"
#include "io/bytes/problems.h"

namespace loft::io {

/// Numbers in rows, a row a line, parted by commas, semicolons, tabs or blanks; blank lines and
/// those that begin with `#` are left out. A first line without a number is a header. Gathers what
/// is wrong with its place. The text must outlive it.
class NumberTable {
 public:
  NumberTable(std::string_view text, std::string_view name);

  /// The header's, in lower case; none where there is no header.
  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }
  /// The column of that name; none if the header has it not.
  [[nodiscard]] std::optional<std::size_t> column(std::string_view name) const;

  /// Goes to the next row; false behind the last one.
  bool next_row();
  [[nodiscard]] bool is_empty(std::size_t column) const { return cell(column).empty(); }
  /// A coordinate that a triangulation takes, or none and a complaint that calls it `what`.
  [[nodiscard]] std::optional<double> coordinate(std::size_t column, const std::string& what);
  /// The same for a length, 0 or more.
  [[nodiscard]] std::optional<double> length(std::size_t column, const std::string& what);

  /// What is wrong with the row.
  void complain(const std::string& problem);
  /// Throws InputError with all complaints, if there are any.
  void raise() const { problems_.raise(name_); }

 private:
  bool next_line();
  void read_head();
  [[nodiscard]] std::string_view cell(std::size_t column) const {
    return column < cells_.size() ? cells_[column] : std::string_view();
  }
  std::optional<double> number(std::size_t column, const std::string& what);

  std::string_view text_;  // what is left of it
  std::string_view name_;
  Problems problems_;
  CsvStyle style_;
  std::vector<std::string> names_;
  std::string_view line_;
  bool is_line_next_ = false;  // the line is there, but is no row yet
  std::size_t number_ = 0;
  std::vector<std::string_view> cells_;
};

}  // namespace loft::io
