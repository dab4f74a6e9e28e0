// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/bytes/csv_rows.h"
#include "io/bytes/problems.h"

namespace loft::io {

/// Numbers in rows, parted by commas, semicolons, tabs or blanks, as CsvRows has them. Gathers what
/// is wrong with its place. The text must outlive it.
class NumberTable {
 public:
  NumberTable(std::string_view text, std::string_view name);

  /// The header's, in lower case; none where there is no header.
  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }
  /// The same as they are written.
  [[nodiscard]] const std::vector<std::string>& written_names() const { return rows_.names(); }
  /// The column of that name, in lower case; none if the header has it not.
  [[nodiscard]] std::optional<std::size_t> column(std::string_view name) const;

  /// Goes to the next row; false behind the last one.
  bool next_row();
  [[nodiscard]] bool is_empty(std::size_t column) const { return cell(column).empty(); }
  /// What a row has in a column, as it is written; nothing where it is shorter. Valid until
  /// next_row().
  [[nodiscard]] std::string_view cell(std::size_t column) const {
    return column < rows_.cells().size() ? rows_.cells()[column] : std::string_view();
  }
  [[nodiscard]] std::size_t cell_count() const { return rows_.cells().size(); }
  /// A finite number, or none and a complaint that calls it `what`.
  [[nodiscard]] std::optional<double> finite(std::size_t column, const std::string& what);
  /// A coordinate that a triangulation takes, or none and a complaint that calls it `what`.
  [[nodiscard]] std::optional<double> coordinate(std::size_t column, const std::string& what);
  /// The same for a length, 0 or more.
  [[nodiscard]] std::optional<double> length(std::size_t column, const std::string& what);

  /// What is wrong with the row.
  void complain(const std::string& problem);
  /// What is wrong with all of it.
  void complain_of_table(const std::string& problem) {
    problems_.add(std::string(name_) + ": " + problem);
  }
  /// Throws InputError with all complaints, if there are any.
  void raise() const { problems_.raise(name_); }

 private:
  std::optional<double> number(std::size_t column, const std::string& what);

  CsvRows rows_;
  std::string_view name_;
  Problems problems_;
  std::vector<std::string> names_;
};

}  // namespace loft::io
