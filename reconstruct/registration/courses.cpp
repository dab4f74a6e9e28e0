// SPDX-License-Identifier: MIT
#include "reconstruct/registration/courses.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "cdt/effort.h"

namespace loft {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// About as many pairs take as long as a test of two triangles.
constexpr std::size_t pairs_of_step = 16;

/// Courses are left in that part of the rows; later, it is better to know them.
constexpr std::size_t early = 8;

/// From middle to middle, as shares of the whole.
std::vector<double> steps(std::span<const Stretch> loop) {
  double whole = 0;
  for (const Stretch& stretch : loop) whole += stretch.length;
  std::vector<double> made;
  double before = loop.back().length;
  for (const Stretch& stretch : loop) {
    made.push_back((before + stretch.length) / (2 * whole));
    before = stretch.length;
  }
  return made;
}

double cost_of(const Stretch& a, const Stretch& b, double direction_weight) {
  const double x = b.middle.x - a.middle.x;
  const double y = b.middle.y - a.middle.y;
  const double cosine = a.normal.x * b.normal.x + a.normal.y * b.normal.y;
  return x * x + y * y + direction_weight * (1 - cosine);
}

/// Pairs of a row, and what it costs at least to come to them.
struct Row {
  ColumnRange range;
  const double* costs;
  const double* least;

  [[nodiscard]] bool has(std::size_t column) const {
    return column >= range.first && column < range.last;
  }
};

/// From a row to the one after it.
void go_on(const PairGrid& grid, std::size_t row_index, const Row& from, const Row& to,
           double* least) {
  const auto [first, last] = to.range;
  const ColumnRange before = from.range;
  const double* const column_steps = grid.column_steps(first);
  const double row_step = grid.row_step(row_index);
  for (std::size_t j = std::max(first, before.first); j < std::min(last, before.last); ++j)
    least[j - first] = from.least[j - before.first] +
                       grid.step_one(to.costs[j - first], from.costs[j - before.first], row_step);
  for (std::size_t j = std::max(first, before.first + 1); j < std::min(last, before.last + 1);
       ++j) {
    const std::size_t k = j - 1 - before.first;
    const double both = from.least[k] + grid.step_both(to.costs[j - first], from.costs[k], row_step,
                                                       column_steps[j - first]);
    least[j - first] = std::min(least[j - first], both);
  }
}

/// Along a row.
void go_along(const PairGrid& grid, const Row& row, double* least) {
  const double* const steps = grid.column_steps(row.range.first);
  for (std::size_t k = 1; k < row.range.last - row.range.first; ++k)
    least[k] =
        std::min(least[k], least[k - 1] + grid.step_one(row.costs[k], row.costs[k - 1], steps[k]));
}

/// From a pair of a row back along the least course, through columns from `first` on, into the row
/// above: its column there.
std::size_t go_back(const PairGrid& grid, std::size_t row_index, const Row& above, const Row& row,
                    std::size_t column, std::size_t& first) {
  const double row_step = grid.row_step(row_index);
  const double* const column_steps = grid.column_steps(row.range.first);
  for (std::size_t j = column;; --j) {
    const double here = row.costs[j - row.range.first];
    const double column_step = column_steps[j - row.range.first];
    const auto from = [&](const Row& other, std::size_t k, const auto& step) {
      const std::size_t place = k - other.range.first;
      return other.has(k) ? other.least[place] + step(other.costs[place]) : infinity;
    };
    const double both = from(above, j - 1, [&](double there) {
      return grid.step_both(here, there, row_step, column_step);
    });
    const double lower =
        from(above, j, [&](double there) { return grid.step_one(here, there, row_step); });
    const double upper =
        from(row, j - 1, [&](double there) { return grid.step_one(here, there, column_step); });
    first = j;
    if (std::min(both, lower) <= upper) return both <= lower ? j - 1 : j;
  }
}

/// What courses that have come to some columns cost at least, but for the rows, until `end`.
double least_from(const double* come, ColumnRange range, std::size_t end,
                  const CostToCome& to_come) {
  double least = infinity;
  for (std::size_t j = range.first; j < range.last; ++j)
    least = std::min(least, come[j - range.first] + to_come.of_columns(j, end));
  return least;
}

/// Goes from row to row, with what pairs cost in memory that is used again.
class Sweep {
 public:
  Sweep(const PairGrid& grid, std::size_t first_row) : grid_(grid), row_(first_row) {}

  /// The next row. `least` is infinite, but 0 where courses start; it has to stay where it is until
  /// the row after it is done.
  void go_to(ColumnRange range, double* least) {
    cdt::spend(1 + (range.last - range.first) / pairs_of_step);
    const Row row{range, grid_.costs(row_, range, memory_), least};
    if (before_.least != nullptr) go_on(grid_, row_, before_, row, least);
    go_along(grid_, row, least);
    before_ = row;
    std::swap(memory_, memory_before_);
    ++row_;
  }

 private:
  const PairGrid& grid_;
  std::size_t row_;
  Row before_{};
  std::vector<double> memory_;
  std::vector<double> memory_before_;
};

/// Some of the rows are looked at whether they can be left.
constexpr std::size_t rows_of_look = 8;

}  // namespace

PairGrid::PairGrid(std::span<const Stretch> lower, std::span<const Stretch> upper,
                   double direction_weight, double pace_weight)
    : lower_(lower),
      upper_(upper),
      direction_weight_(direction_weight),
      pace_weight_(pace_weight),
      columns_(upper.size()),
      row_steps_(steps(lower)),
      column_steps_(steps(upper)) {
  constexpr std::size_t most_in_table = std::size_t{1} << 19U;
  const auto go_round_again = [&](std::vector<double>& values) {
    for (std::size_t j = 0; j < columns_; ++j) values.push_back(values[values.size() - columns_]);
  };
  go_round_again(column_steps_);
  column_steps_.push_back(column_steps_[0]);
  if (rows() > most_in_table / columns_) return;
  table_.reserve(2 * rows() * columns_);
  for (const Stretch& a : lower) {
    for (const Stretch& b : upper) table_.push_back(cost_of(a, b, direction_weight));
    go_round_again(table_);
  }
}

double PairGrid::cost(std::size_t row, std::size_t column) const {
  row %= rows();
  column %= columns_;
  return table_.empty() ? cost_of(lower_[row], upper_[column], direction_weight_)
                        : table_[2 * row * columns_ + column];
}

const double* PairGrid::costs(std::size_t row, ColumnRange range,
                              std::vector<double>& memory) const {
  row %= rows();
  std::size_t column = range.first % columns_;
  const std::size_t count = range.last - range.first;
  if (!table_.empty() && column + count <= 2 * columns_)
    return table_.data() + 2 * row * columns_ + column;
  memory.resize(count);
  for (double& cost : memory) {
    cost = this->cost(row, column);
    if (++column == columns_) column = 0;
  }
  return memory.data();
}

CostToCome::CostToCome(const PairGrid& grid) {
  const std::size_t rows = grid.rows();
  const std::size_t columns = grid.columns();
  std::vector<double> least_of_rows(rows, infinity);
  std::vector<double> least_of_columns(columns, infinity);
  std::vector<double> memory;
  for (std::size_t i = 0; i < rows; ++i) {
    const double* const costs = grid.costs(i, {0, columns}, memory);
    for (std::size_t j = 0; j < columns; ++j) {
      least_of_rows[i] = std::min(least_of_rows[i], costs[j]);
      least_of_columns[j] = std::min(least_of_columns[j], costs[j]);
    }
  }
  const auto step = [](const std::vector<double>& least, std::size_t i, double way) {
    const std::size_t count = least.size();
    return (least[i % count] + least[(i + 1) % count]) / 2 * way;
  };
  of_rows_.resize(rows + 1);
  for (std::size_t i = rows; i-- > 0;)
    of_rows_[i] = of_rows_[i + 1] + step(least_of_rows, i, grid.row_step(i + 1));
  of_columns_.resize(2 * columns + 1);
  for (std::size_t j = 2 * columns; j-- > 0;)
    of_columns_[j] = of_columns_[j + 1] + step(least_of_columns, j, *grid.column_steps(j + 1));
}

bool may_cost_less(const PairGrid& grid, ColumnRange starts, std::span<const ColumnRange> ranges,
                   const CostToCome& to_come, double most) {
  const ColumnRange ends{starts.first + grid.columns(), starts.last + grid.columns()};
  Sweep sweep(grid, 0);
  ColumnRange range{};
  std::vector<double> least;
  std::vector<double> least_before;
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    std::swap(least, least_before);
    range = {std::max(ranges[i].first, starts.first), std::min(ranges[i].last, ends.last)};
    least.assign(range.last - range.first, infinity);
    if (i == 0) std::fill_n(least.begin(), starts.last - starts.first, 0.0);
    sweep.go_to(range, least.data());
    if (i % rows_of_look == 0 &&
        !(least_from(least.data(), range, ends.first, to_come) + to_come.of_rows(i) < most))
      return false;
  }
  const double* const end = least.data() - range.first;
  return *std::min_element(end + ends.first, end + ends.last) < most;
}

Courses::Courses(const PairGrid& grid, std::size_t first_row, std::vector<ColumnRange> ranges)
    : grid_(grid), first_row_(first_row), ranges_(std::move(ranges)), starts_{0} {
  fill_forward(nullptr, infinity);
}

Courses::Courses(const PairGrid& grid, std::vector<ColumnRange> ranges, const CostToCome& to_come,
                 double most)
    : grid_(grid), first_row_(0), ranges_(std::move(ranges)), starts_{0} {
  fill_forward(&to_come, most);
}

void Courses::fill_forward(const CostToCome* to_come, double most) {
  std::size_t count = 0;
  for (const ColumnRange range : ranges_) count += range.last - range.first;
  forward_.reserve(count);
  Sweep sweep(grid_, first_row_);
  for (std::size_t i = 0; i < ranges_.size(); ++i) {
    starts_.push_back(starts_.back() + ranges_[i].last - ranges_[i].first);
    forward_.resize(starts_.back(), infinity);
    if (i == 0) forward_[0] = 0;
    sweep.go_to(ranges_[i], forward_.data() + starts_[i]);
    const bool is_early = i < ranges_.size() / early;
    is_found_ = to_come == nullptr || !is_early || least_through(i, *to_come) < most;
    if (!is_found_) return;
  }
}

/// What a course through a row costs at least.
double Courses::least_through(std::size_t i, const CostToCome& to_come) const {
  return least_from(forward_.data() + starts_[i], ranges_[i], ranges_.back().last - 1, to_come) +
         to_come.of_rows(i);
}

std::vector<double> Courses::fill_backward() const {
  std::vector<double> backward(starts_.back(), infinity);
  backward.back() = 0;
  std::vector<double> memory;
  std::vector<double> memory_after;
  const double* costs_after = nullptr;
  for (std::size_t i = ranges_.size(); i-- > 0;) {
    const auto [first, last] = ranges_[i];
    cdt::spend(1 + (last - first) / pairs_of_step);
    const double* const costs = grid_.costs(first_row_ + i, ranges_[i], memory);
    const double* const column_steps = grid_.column_steps(first);
    double* const row = backward.data() + starts_[i];
    if (i + 1 < ranges_.size()) {
      const ColumnRange after = ranges_[i + 1];
      const double* const below = backward.data() + starts_[i + 1];
      const double row_step = grid_.row_step(first_row_ + i + 1);
      for (std::size_t j = std::max(first, after.first); j < std::min(last, after.last); ++j)
        row[j - first] = below[j - after.first] +
                         grid_.step_one(costs[j - first], costs_after[j - after.first], row_step);
      for (std::size_t j = std::max(first + 1, after.first); j < std::min(last + 1, after.last);
           ++j) {
        const std::size_t k = j - after.first;
        const double both = below[k] + grid_.step_both(costs[j - 1 - first], costs_after[k],
                                                       row_step, column_steps[j - first]);
        row[j - 1 - first] = std::min(row[j - 1 - first], both);
      }
    }
    for (std::size_t k = last - first - 1; k-- > 0;)
      row[k] = std::min(row[k],
                        row[k + 1] + grid_.step_one(costs[k], costs[k + 1], column_steps[k + 1]));
    costs_after = costs;
    std::swap(memory, memory_after);
  }
  return backward;
}

std::vector<ColumnRange> Courses::course() const {
  std::vector<ColumnRange> course(ranges_.size());
  std::vector<double> memory;
  std::vector<double> memory_above;
  const auto row_at = [&](std::size_t i, std::vector<double>& where) {
    return Row{ranges_[i], grid_.costs(first_row_ + i, ranges_[i], where),
               forward_.data() + starts_[i]};
  };
  std::size_t column = ranges_.back().last - 1;
  Row row = row_at(ranges_.size() - 1, memory);
  for (std::size_t i = ranges_.size() - 1; i > 0; --i) {
    const Row above = row_at(i - 1, memory_above);
    course[i].last = column + 1;
    column = go_back(grid_, first_row_ + i, above, row, column, course[i].first);
    row = above;
    std::swap(memory, memory_above);
  }
  course[0] = {ranges_[0].first, column + 1};
  return course;
}

}  // namespace loft
