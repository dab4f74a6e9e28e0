// SPDX-License-Identifier: MIT
#include "io/planar/path_queries.h"

#include <array>
#include <cstddef>
#include <string>

#include "io/planar/number_table.h"

namespace loft::io {

namespace {

constexpr std::array<std::string_view, 5> query_columns{"x0", "y0", "x1", "y1", "radius"};

class PathQueriesReader {
 public:
  PathQueriesReader(std::string_view text, std::string_view name)
      : table_(text, name), name_(name) {}

  std::vector<PathQuery> read() {
    if (!table_.names().empty()) take_columns();
    while (table_.next_row()) read_query();
    table_.raise();
    if (queries_.empty()) throw InputError(std::string(name_) + ": no queries in it");
    return std::move(queries_);
  }

 private:
  void take_columns() {
    Problems problems;
    for (std::size_t i = 0; i < query_columns.size(); ++i) {
      columns_[i] = table_.column(query_columns[i]);
      if (columns_[i] || query_columns[i] == "radius") continue;
      problems.add(std::string(name_) + ": no column " + std::string(query_columns[i]) +
                   "; the header names x0, y0, x1, y1, and radius or not");
    }
    problems.raise(name_);
  }

  void read_query() {
    std::array<std::optional<double>, 4> ends;
    for (std::size_t i = 0; i < ends.size(); ++i)
      ends[i] = table_.coordinate(*columns_[i], std::string(query_columns[i]));
    std::optional<double> radius;
    if (columns_[4] && !table_.is_empty(*columns_[4]))
      radius = table_.length(*columns_[4], "radius");
    if (ends[0] && ends[1] && ends[2] && ends[3])
      queries_.push_back({{*ends[0], *ends[1]}, {*ends[2], *ends[3]}, radius});
  }

  NumberTable table_;
  std::string_view name_;
  std::array<std::optional<std::size_t>, 5> columns_{0, 1, 2, 3, 4};
  std::vector<PathQuery> queries_;
};

}  // namespace

std::vector<PathQuery> read_path_queries_csv(std::string_view text, std::string_view name) {
  return PathQueriesReader(text, name).read();
}

}  // namespace loft::io
