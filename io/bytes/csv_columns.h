// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace loft::io {

/// What parts the cells of a line, and what is before the fractions of numbers.
struct CsvStyle {
  char separator = ',';  ///< ' ' stands for any blanks
  char point = '.';
};

/// What is in a column.
enum class CsvColumn { x, y, z, contour, label };
inline constexpr std::size_t csv_columns = 5;

/// Which column holds what.
struct CsvHeader {
  std::array<std::optional<std::size_t>, csv_columns> place;
  std::string unit;
  std::vector<std::string> unknown;  ///< the names of other columns

  [[nodiscard]] std::optional<std::size_t> of(CsvColumn column) const {
    return place[static_cast<std::size_t>(column)];
  }
};

/// Guesses by a header, and the first line behind it (both may be empty).
[[nodiscard]] CsvStyle find_csv_style(std::string_view header, std::string_view line);

/// The cells of a line, without blanks and quotes around them.
[[nodiscard]] std::vector<std::string_view> csv_cells(std::string_view line, const CsvStyle& style);

/// None if the text is no number. NaN and infinities are numbers.
[[nodiscard]] std::optional<double> csv_number(std::string_view cell, const CsvStyle& style);

[[nodiscard]] CsvHeader read_csv_header(const std::vector<std::string_view>& cells);

}  // namespace loft::io
