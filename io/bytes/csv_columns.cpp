// SPDX-License-Identifier: MIT
#include "io/bytes/csv_columns.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <system_error>

#include "io/bytes/words.h"

namespace loft::io {

namespace {

constexpr std::string_view csv_blanks = " \t\r\v\f";

struct ColumnName {
  std::string_view name;
  CsvColumn column;
};
constexpr std::array column_names{
    ColumnName{"x", CsvColumn::x},
    ColumnName{"y", CsvColumn::y},
    ColumnName{"z", CsvColumn::z},
    ColumnName{"height", CsvColumn::z},
    ColumnName{"elevation", CsvColumn::z},
    ColumnName{"contour", CsvColumn::contour},
    ColumnName{"contour_id", CsvColumn::contour},
    ColumnName{"contourid", CsvColumn::contour},
    ColumnName{"loop", CsvColumn::contour},
    ColumnName{"ring", CsvColumn::contour},
    ColumnName{"polygon", CsvColumn::contour},
    ColumnName{"curve", CsvColumn::contour},
    ColumnName{"label", CsvColumn::label},
    ColumnName{"name", CsvColumn::label},
    ColumnName{"structure", CsvColumn::label},
    ColumnName{"roi", CsvColumn::label},
    ColumnName{"organ", CsvColumn::label},
    ColumnName{"object", CsvColumn::label},
};

std::string_view content_of(std::string_view text) {
  text = without_blanks(text);
  if (text.size() > 1 && text.front() == '"' && text.back() == '"')
    text = text.substr(1, text.size() - 2);
  return text;
}

/// Where the cell that begins at `begin` ends.
std::size_t end_of_cell(std::string_view line, std::size_t begin, char separator) {
  const std::size_t first = line.find_first_not_of(csv_blanks, begin);
  if (first != std::string_view::npos && line[first] == '"') {
    const std::size_t quote = line.find('"', first + 1);
    if (quote != std::string_view::npos) begin = quote + 1;
  }
  const std::size_t end =
      separator == ' ' ? line.find_first_of(csv_blanks, begin) : line.find(separator, begin);
  return std::min(end, line.size());
}

}  // namespace

CsvStyle find_csv_style(std::string_view header, std::string_view line) {
  CsvStyle style;
  const std::string_view by = header.empty() ? line : header;
  const auto parts = [&](char c) { return by.find(c) != std::string_view::npos; };
  style.separator = parts('\t') ? '\t' : parts(';') ? ';' : ' ';
  if (style.separator == ' ') {
    // `1,5 2,5 3,5` has numbers with commas, `1.5, 2.5, 3.5` a comma after each.
    const std::vector<std::string_view> words = csv_cells(by, style);
    const bool are_numbers =
        header.empty() && words.size() >= 3 &&
        std::ranges::none_of(words, [](std::string_view word) {
          return word.find(',') == 0 || word.ends_with(',') || std::ranges::count(word, ',') > 1;
        });
    if (parts(',') && !are_numbers) style.separator = ',';
  }
  if (style.separator == ',') return style;
  const bool has_point = line.find('.') != std::string_view::npos;
  if (!has_point && line.find(',') != std::string_view::npos) style.point = ',';
  return style;
}

std::vector<std::string_view> csv_cells(std::string_view line, const CsvStyle& style) {
  std::vector<std::string_view> cells;
  if (style.separator == ' ')
    line = line.substr(std::min(line.find_first_not_of(csv_blanks), line.size()));
  std::size_t begin = 0;
  while (begin < line.size()) {
    const std::size_t end = end_of_cell(line, begin, style.separator);
    cells.push_back(content_of(line.substr(begin, end - begin)));
    begin = end + 1;
    if (style.separator == ' ')
      begin = std::min(line.find_first_not_of(csv_blanks, end), line.size());
  }
  return cells;
}

std::optional<double> csv_number(std::string_view cell, const CsvStyle& style) {
  std::string with_point;
  if (style.point == ',' || cell.find(',') != std::string_view::npos) {
    with_point = cell;
    std::ranges::replace(with_point, ',', '.');  // `"1,5"` in quotes, too
    cell = with_point;
  }
  if (cell.starts_with('+')) cell.remove_prefix(1);
  double number = 0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), number);
  if (error != std::errc() || end != cell.data() + cell.size()) return {};
  return number;
}

CsvHeader read_csv_header(const std::vector<std::string_view>& cells) {
  CsvHeader header;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const std::size_t bracket = cells[i].find_first_of("[(");
    std::string name(content_of(cells[i].substr(0, bracket)));
    std::ranges::transform(name, name.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    const auto found = std::ranges::find(column_names, name, &ColumnName::name);
    if (found == column_names.end()) {
      header.unknown.emplace_back(cells[i]);
      continue;
    }
    auto& place = header.place[static_cast<std::size_t>(found->column)];
    if (!place) place = i;
    if (found->column == CsvColumn::x && bracket != std::string_view::npos) {
      const std::string_view unit = cells[i].substr(bracket + 1);
      header.unit = content_of(unit.substr(0, unit.find_first_of("])")));
    }
  }
  return header;
}

}  // namespace loft::io
