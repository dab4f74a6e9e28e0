// SPDX-License-Identifier: MIT
#include "io/planar/points_csv.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>

#include "io/bytes/csv_columns.h"
#include "io/bytes/problems.h"
#include "io/bytes/text.h"
#include "io/bytes/words.h"
#include "io/planar/coordinate.h"

namespace loft::io {

namespace {

class PointsReader {
 public:
  PointsReader(std::string_view text, std::string_view name) : text_(text), name_(name) {}

  std::vector<cdt::Point> read() {
    if (next_line()) read_head();
    for (bool is_there = !line_.empty(); is_there; is_there = next_line()) read_point();
    problems_.raise(name_);
    if (points_.empty()) throw InputError(std::string(name_) + ": no points in it");
    return std::move(points_);
  }

 private:
  /// Goes to the next line that has something.
  bool next_line() {
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

  /// A first line without a number names the columns. It is followed by the first point.
  void read_head() {
    style_ = find_csv_style("", line_);
    const std::vector<std::string_view> cells = csv_cells(line_, style_);
    const auto is_number = [&](auto cell) { return csv_number(cell, style_).has_value(); };
    if (std::ranges::any_of(cells, is_number)) return;
    const std::string_view header = line_;
    next_line();
    style_ = find_csv_style(header, line_);
    take_names(csv_cells(header, style_));
  }

  void take_names(const std::vector<std::string_view>& cells) {
    constexpr std::array<std::pair<std::string_view, std::string_view>, 4> known{
        {{"x", "y"}, {"lon", "lat"}, {"lng", "lat"}, {"longitude", "latitude"}}};
    const auto place_of = [&](std::string_view name) {
      const auto found = std::ranges::find(cells, name, [](auto c) { return in_lower_case(c); });
      return static_cast<std::size_t>(found - cells.begin());
    };
    for (const auto& [x, y] : known) {
      if (place_of(x) == cells.size() || place_of(y) == cells.size()) continue;
      columns_ = {place_of(x), place_of(y)};
      return;
    }
  }

  void read_point() {
    cells_ = csv_cells(line_, style_);
    const auto x = coordinate(columns_[0], "x");
    const auto y = coordinate(columns_[1], "y");
    if (x && y) points_.push_back({*x, *y});
  }

  std::optional<double> coordinate(std::size_t column, const std::string& name) {
    const std::string_view cell = column < cells_.size() ? cells_[column] : std::string_view();
    const auto value = csv_number(cell, style_);
    if (value && is_coordinate(*value)) return value;
    if (value)
      complain(name + ": " + why_no_coordinate(*value));
    else if (cell.empty())
      complain(name + " is missing");
    else
      complain("expected a number for " + name + ", found " + in_quotes(cell));
    return {};
  }

  void complain(const std::string& problem) {
    problems_.add(std::string(name_) + ':' + std::to_string(number_) + ": " + problem);
  }

  std::string_view text_;  // what is left of it
  std::string_view name_;
  Problems problems_;
  CsvStyle style_;
  std::array<std::size_t, 2> columns_{0, 1};
  std::string_view line_;
  std::size_t number_ = 0;
  std::vector<std::string_view> cells_;
  std::vector<cdt::Point> points_;
};

}  // namespace

std::vector<cdt::Point> read_points_csv(std::string_view text, std::string_view name) {
  return PointsReader(without_mark(text), name).read();
}

}  // namespace loft::io
