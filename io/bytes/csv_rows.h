// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/bytes/csv_columns.h"

namespace loft::io {

/// The rows of a table. Where commas, semicolons or tabs part the cells it is CSV as RFC 4180 has
/// it, read by libcsv: cells in double quotes may have any of these, ends of lines, and quotes,
/// which are doubled. Where blanks part them, a row is a line. Blanks around cells are no part of
/// them; lines that are blank or begin with `#` are left out, unless they are in quotes. A byte
/// order mark is left out. A first row without a number is a header.
class CsvRows {
 public:
  /// The text must outlive it.
  explicit CsvRows(std::string_view text);
  ~CsvRows();
  CsvRows(CsvRows&&) noexcept;
  CsvRows& operator=(CsvRows&&) noexcept;

  [[nodiscard]] const CsvStyle& style() const { return style_; }
  /// The header's cells; none where there is no header.
  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }

  /// Goes to the next row behind the header; false behind the last one. Cost: its length.
  bool next();
  /// Valid until next().
  [[nodiscard]] std::span<const std::string_view> cells() const { return cells_; }
  /// The line in which the row begins, from 1.
  [[nodiscard]] std::size_t line() const { return line_; }
  /// Behind the last row: whether it has a quotation mark without its mate.
  [[nodiscard]] bool ends_in_quotes() const;

 private:
  struct Parser;

  [[nodiscard]] std::optional<std::string_view> next_line();
  void find_style();
  bool parse_row();

  std::string_view text_;  // what is left of it
  std::size_t number_ = 0;
  CsvStyle style_;
  std::vector<std::string> names_;
  std::vector<std::string_view> cells_;
  std::size_t line_ = 0;
  std::unique_ptr<Parser> parser_;  // none where blanks part the cells
};

}  // namespace loft::io
