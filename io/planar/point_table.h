// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cdt/point.h"

namespace loft::io {

/// A column of numbers that is asked for.
struct WantedColumn {
  std::vector<std::string> names;  ///< the first of these that the table has is meant
  bool is_needed = true;           ///< a table without it is bad
};

/// Numbers from one column, a row each.
struct ValueColumn {
  std::size_t column = 0;  ///< in the table
  std::vector<double> values;
};

/// Points in rows, and what else is in these. Memory: some bytes a cell, and the text.
class PointTable {
 public:
  /// What the columns are called: as the header has it, or, where there is no header, x, y, value,
  /// and from the fourth on `column 4`.
  [[nodiscard]] std::span<const std::string> names() const { return names_; }
  /// A row each. All coordinates are such that a triangulation takes them.
  [[nodiscard]] std::span<const cdt::Point> points() const { return points_; }
  /// What was asked for, in that order; none where the table has no such column.
  [[nodiscard]] std::span<const std::optional<ValueColumn>> values() const { return values_; }
  /// As it is written, without blanks and quotes around it; nothing where the row is shorter.
  [[nodiscard]] std::string_view cell(std::size_t row, std::size_t column) const;
  /// The columns that x and y are in.
  [[nodiscard]] std::size_t x_column() const { return x_column_; }
  [[nodiscard]] std::size_t y_column() const { return y_column_; }

 private:
  friend class PointTableReader;

  std::vector<std::string> names_;
  std::vector<cdt::Point> points_;
  std::vector<std::optional<ValueColumn>> values_;
  std::size_t x_column_ = 0;
  std::size_t y_column_ = 1;
  std::string text_;                    // of all cells
  std::vector<std::size_t> cell_ends_;  // in it
  std::vector<std::size_t> row_ends_;   // in cell_ends_
};

/// Reads a table of points, one a row, parted by commas, semicolons, tabs or blanks; cells may be
/// in quotes (RFC 4180). A header may name the columns x and y, or lon and lat, capitals aside;
/// else these are the first two. Blank lines and lines that begin with `#` are left out.
///
/// Throws InputError that names `name`, line and column of each bad place: cells of x, y and what
/// is wanted that are missing or no numbers, not finite or, of x and y, not usable; wanted columns
/// that there are not; that there is no point. Cost: O(n).
[[nodiscard]] PointTable read_point_table_csv(std::string_view text, std::string_view name,
                                              std::span<const WantedColumn> wanted);

}  // namespace loft::io
