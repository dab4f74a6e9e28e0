// SPDX-License-Identifier: MIT
#include "io/planar/point_table.h"

#include <array>
#include <utility>

#include "io/bytes/text.h"
#include "io/bytes/words.h"
#include "io/planar/columns_of_points.h"
#include "io/planar/number_table.h"

namespace loft::io {

std::string_view PointTable::cell(std::size_t row, std::size_t column) const {
  const std::size_t first = row == 0 ? 0 : row_ends_[row - 1];
  if (column >= row_ends_[row] - first) return {};
  const std::size_t number = first + column;
  const std::size_t begin = number == 0 ? 0 : cell_ends_[number - 1];
  return std::string_view(text_).substr(begin, cell_ends_[number] - begin);
}

/// Fills a PointTable.
class PointTableReader {
 public:
  PointTableReader(std::string_view text, std::string_view name) : rows_(text, name), name_(name) {}

  PointTable read(std::span<const WantedColumn> wanted) {
    bool is_row_there = rows_.next_row();
    take_names();
    for (const WantedColumn& column : wanted) find(column);
    for (; is_row_there; is_row_there = rows_.next_row()) take_row();
    rows_.raise();
    if (table_.points_.empty()) throw InputError(std::string(name_) + ": no points in it");
    return std::move(table_);
  }

 private:
  void take_names() {
    table_.names_ = rows_.written_names();
    const auto [x, y] = columns_of_points(rows_);
    table_.x_column_ = x;
    table_.y_column_ = y;
    constexpr std::array<std::string_view, 3> usual{"x", "y", "value"};
    if (!table_.names_.empty()) return;
    for (std::size_t i = 0; i < rows_.cell_count(); ++i)
      table_.names_.push_back(i < usual.size() ? std::string(usual[i])
                                               : "column " + std::to_string(i + 1));
  }

  [[nodiscard]] std::optional<std::size_t> column(const std::string& name) const {
    for (std::size_t i = 0; i < table_.names_.size(); ++i)
      if (in_lower_case(table_.names_[i]) == in_lower_case(name)) return i;
    return {};
  }

  void find(const WantedColumn& wanted) {
    auto& values = table_.values_.emplace_back();
    for (const std::string& name : wanted.names)
      if (const auto found = column(name); found && !values) values.emplace().column = *found;
    if (values || !wanted.is_needed || wanted.names.empty()) return;
    std::string known;
    for (const std::string& name : table_.names_)
      known += (known.empty() ? "" : ", ") + in_quotes(name);
    rows_.complain_of_table("no column " + in_quotes(wanted.names.front()) + "; the columns are " +
                            (known.empty() ? "none" : known));
  }

  void take_row() {
    const auto x = rows_.coordinate(table_.x_column_, "x");
    const auto y = rows_.coordinate(table_.y_column_, "y");
    for (auto& values : table_.values_)
      if (values)
        values->values.push_back(
            rows_.finite(values->column, one_line(table_.names_[values->column])).value_or(0));
    if (!x || !y) return;
    table_.points_.push_back({*x, *y});
    for (std::size_t i = 0; i < rows_.cell_count(); ++i) {
      table_.text_ += rows_.cell(i);
      table_.cell_ends_.push_back(table_.text_.size());
    }
    table_.row_ends_.push_back(table_.cell_ends_.size());
  }

  NumberTable rows_;
  std::string_view name_;
  PointTable table_;
};

PointTable read_point_table_csv(std::string_view text, std::string_view name,
                                std::span<const WantedColumn> wanted) {
  return PointTableReader(text, name).read(wanted);
}

}  // namespace loft::io
