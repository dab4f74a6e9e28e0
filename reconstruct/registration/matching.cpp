// SPDX-License-Identifier: MIT
#include "reconstruct/registration/matching.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "reconstruct/registration/courses.h"

namespace loft {

namespace {

/// Courses that differ by no more than that share are the same but for rounding.
constexpr double rounding = 1e-9;

/// Loops of more stretches are matched by runs of them first.
constexpr std::size_t most_at_once = 640;
/// How many times as many there are each time that runs are taken apart.
constexpr std::size_t refinement = 4;
/// How many stretches, or runs, a course may stray from one that is known.
constexpr std::size_t slack = 12;

/// For each row of a grid some columns; rows and columns go on for ever, round by round. Columns
/// are counted from some rounds before, so that there is room below the first.
class Band {
 public:
  Band(std::vector<ColumnRange> rows, std::size_t columns)
      : rows_(std::move(rows)), columns_(columns) {
    std::size_t least = rows_[0].first;
    for (const ColumnRange range : rows_) least = std::min(least, range.first);
    const std::size_t rounds = least / columns_;
    for (ColumnRange& range : rows_) {
      range.first = range.first + 2 * columns_ - rounds * columns_;
      range.last = range.last + 2 * columns_ - rounds * columns_;
    }
  }

  [[nodiscard]] std::size_t row_count() const { return rows_.size(); }
  [[nodiscard]] ColumnRange operator[](std::size_t row) const {
    const std::size_t rounds = row / rows_.size() * columns_;
    const ColumnRange range = rows_[row % rows_.size()];
    return {range.first + rounds, range.last + rounds};
  }

  /// Wider by columns and by rows.
  [[nodiscard]] Band widened() const {
    const std::size_t count = rows_.size();
    const std::size_t rows = std::min(slack, count);
    std::vector<ColumnRange> wide;
    for (std::size_t i = 0; i < count; ++i)
      wide.push_back({(*this)[i + count - rows].first - columns_ - std::min(slack, columns_),
                      (*this)[i + rows].last + slack});
    return {std::move(wide), columns_};
  }

  /// What is of it in a round from a pair on.
  [[nodiscard]] std::vector<ColumnRange> round(std::size_t row, std::size_t column) const {
    std::vector<ColumnRange> ranges;
    for (std::size_t i = 0; i <= rows_.size(); ++i) {
      const ColumnRange range = (*this)[row + i];
      ranges.push_back(
          {std::max(range.first, column), std::min(range.last, column + columns_ + 1)});
    }
    return ranges;
  }

 private:
  std::vector<ColumnRange> rows_;
  std::size_t columns_;
};

/// A course from a row of the first round on, as a band. Its last row is its first one, a round
/// later.
Band band_of(const std::vector<ColumnRange>& course, std::size_t first_row, std::size_t columns) {
  const std::size_t count = course.size() - 1;
  std::vector<ColumnRange> rows(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t row = first_row + i;
    const std::size_t rounds = row / count * columns;
    const std::size_t first = i == 0 ? course.back().first - columns : course[i].first;
    rows[row % count] = {first + columns - rounds, course[i].last + columns - rounds};
  }
  return {std::move(rows), columns};
}

/// The least course of all, wherever it starts: courses that start between two others need not
/// cross these (Maes, 1990), and most can be left soon, as they cost more than a good one.
class LeastCourse {
 public:
  explicit LeastCourse(const PairGrid& grid) : grid_(grid), to_come_(grid) {}

  [[nodiscard]] Band find() {
    const std::size_t columns = grid_.columns();
    const std::vector<ColumnRange> all(grid_.rows() + 1, {0, 2 * columns});
    guess();
    const auto first = course(0, all);
    const std::vector<ColumnRange> low = first.value_or(all);
    std::vector<ColumnRange> high = all;
    if (first)
      for (std::size_t i = 0; i < high.size(); ++i)
        high[i] = {low[i].first + columns, low[i].last + columns};
    search(0, columns, low, high);
    return band_of(best_, first_row_, columns);
  }

 private:
  /// What is the least through a pair of that which is the least through the best pair.
  void guess() {
    const std::size_t rows = grid_.rows();
    const std::size_t columns = grid_.columns();
    const auto round_from = [&](std::size_t column) {
      return std::vector<ColumnRange>(rows + 1, {column, column + columns + 1});
    };
    std::vector<double> memory;
    const double* const costs = grid_.costs(0, {0, columns}, memory);
    const auto nearest = static_cast<std::size_t>(std::min_element(costs, costs + columns) - costs);
    const std::vector<ColumnRange> there = Courses(grid_, 0, round_from(nearest)).course();
    first_row_ = rows / 2;
    const Courses better(grid_, first_row_, round_from(there[first_row_].first));
    least_ = better.least();
    best_ = better.course();
  }

  /// The least one from a column on, in some ranges; none if it costs no less than what is known.
  std::optional<std::vector<ColumnRange>> course(std::size_t start,
                                                 std::vector<ColumnRange> ranges) {
    for (ColumnRange& range : ranges)
      range = {std::max(range.first, start), std::min(range.last, start + grid_.columns() + 1)};
    const Courses courses(grid_, std::move(ranges), to_come_, (1 - rounding) * least_);
    if (!courses.is_found()) return {};
    if (courses.least() < (1 - rounding) * least_) {
      least_ = courses.least();
      first_row_ = 0;
      best_ = courses.course();
    }
    return courses.course();
  }

  void search(std::size_t from, std::size_t to, const std::vector<ColumnRange>& low,
              const std::vector<ColumnRange>& high) {
    if (to - from < 2) return;
    const std::size_t middle = from + (to - from) / 2;
    std::vector<ColumnRange> between;
    for (std::size_t i = 0; i < low.size(); ++i) between.push_back({low[i].first, high[i].last});
    if (to - from > 2 &&
        !may_cost_less(grid_, {from + 1, to}, between, to_come_, (1 - rounding) * least_))
      return;
    const auto found = course(middle, std::move(between));
    search(from, middle, low, found.value_or(high));
    search(middle, to, found.value_or(low), high);
  }

  const PairGrid& grid_;
  CostToCome to_come_;
  double least_ = 0;
  std::size_t first_row_ = 0;  // of the best one
  std::vector<ColumnRange> best_;
};

/// The least courses in a band through a pair of another one, which lies in it but for whole
/// rounds: through that of all rounds that costs least, as a band may be wider than a round.
Courses courses_through(const PairGrid& grid, const Band& band, const Band& other,
                        std::size_t row) {
  const std::size_t columns = grid.columns();
  const ColumnRange range = other[row];
  const std::size_t middle = range.first + (range.last - 1 - range.first) / 2;
  const std::size_t first = band[row].first;
  std::size_t column = first + (middle % columns + columns - first % columns) % columns;
  std::optional<Courses> best(std::in_place, grid, row, band.round(row, column));
  while ((column += columns) < band[row].last) {
    Courses more(grid, row, band.round(row, column));
    if (more.least() < best->least()) best.emplace(std::move(more));
  }
  return std::move(*best);
}

/// The least course in a band: through a pair of that which is the least through a pair far away.
Band settled(const PairGrid& grid, const Band& band) {
  const std::size_t half = grid.rows() / 2;
  const Band there =
      band_of(courses_through(grid, band, band, half).course(), half, grid.columns());
  return band_of(courses_through(grid, band, there, 0).course(), 0, grid.columns());
}

/// Runs of a loop's stretches, as one stretch each.
std::vector<Stretch> runs(std::span<const Stretch> loop, std::size_t length) {
  std::vector<Stretch> made;
  for (std::size_t i = 0; i < loop.size(); i += length) {
    Stretch run = loop[i];
    run.middle = run.normal = {};
    run.length = 0;
    for (const Stretch& part : loop.subspan(i, std::min(length, loop.size() - i))) {
      const auto add = [&](cdt::Point& sum, cdt::Point more) {
        sum = {sum.x + part.length * more.x, sum.y + part.length * more.y};
      };
      add(run.middle, part.middle);
      add(run.normal, part.normal);
      run.length += part.length;
    }
    run.middle = {run.middle.x / run.length, run.middle.y / run.length};
    const double size = std::hypot(run.normal.x, run.normal.y);
    if (size > 0) run.normal = {run.normal.x / size, run.normal.y / size};
    made.push_back(run);
  }
  return made;
}

/// How long runs are of which there are few enough to be matched at once.
std::size_t run_length(std::size_t count) {
  std::size_t length = 1;
  while (count > most_at_once * length) length *= refinement;
  return length;
}

/// A band of pairs of runs as one of what these runs consist of: so many columns of `grid` each,
/// and so many rows.
Band refined(const Band& band, std::size_t run_columns, const PairGrid& grid,
             std::size_t rows_of_run, std::size_t columns_of_run) {
  const auto place = [&](std::size_t run) {
    const std::size_t inside = run % run_columns * columns_of_run;
    return run / run_columns * grid.columns() + std::min(inside, grid.columns());
  };
  std::vector<ColumnRange> fine;
  for (std::size_t i = 0; i < grid.rows(); ++i) {
    const ColumnRange range = band[i / rows_of_run];
    fine.push_back({place(range.first), place(range.last - 1) + columns_of_run});
  }
  return {std::move(fine), grid.columns()};
}

/// The pairs of all least courses. Near its start a course cannot stray, so from two starts.
std::vector<Match> least_pairs(const PairGrid& grid, const Band& course) {
  const std::size_t rows = grid.rows();
  const double same = rounding * grid.pace_weight();
  const Band band = course.widened();
  std::vector<Match> pairs;
  const auto take = [&](std::size_t row, std::size_t column) {
    pairs.push_back({static_cast<std::uint32_t>(row % rows),
                     static_cast<std::uint32_t>(column % grid.columns())});
  };
  const std::size_t quarter = rows / 4;
  const std::size_t half = rows / 2;
  const Courses from_first = courses_through(grid, band, course, 0);
  from_first.for_each_least(quarter, quarter + half, rounding * from_first.least() + same, take);
  const Courses from_half = courses_through(grid, band, course, half);
  from_half.for_each_least(quarter, quarter + rows - half, rounding * from_half.least() + same,
                           take);
  return pairs;
}

}  // namespace

std::vector<Match> match_outlines(std::span<const Stretch> lower, std::span<const Stretch> upper,
                                  double direction_weight, double pace_weight) {
  std::size_t row_length = run_length(lower.size());
  std::size_t column_length = run_length(upper.size());
  std::vector<Stretch> below = runs(lower, row_length);
  std::vector<Stretch> above = runs(upper, column_length);
  std::optional<PairGrid> grid;
  grid.emplace(below, above, direction_weight, pace_weight);
  Band course = LeastCourse(*grid).find();
  while (row_length > 1 || column_length > 1) {
    const std::size_t run_columns = above.size();
    const std::size_t rows_of_run = std::min(row_length, refinement);
    const std::size_t columns_of_run = std::min(column_length, refinement);
    row_length /= rows_of_run;
    column_length /= columns_of_run;
    below = runs(lower, row_length);
    above = runs(upper, column_length);
    grid.emplace(below, above, direction_weight, pace_weight);
    course =
        settled(*grid, refined(course, run_columns, *grid, rows_of_run, columns_of_run).widened());
  }
  return least_pairs(*grid, course);
}

}  // namespace loft
