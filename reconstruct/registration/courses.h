// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "reconstruct/registration/outline.h"

namespace loft {

/// Columns of a row: of a stretch of the lower loop, those of the upper one.
struct ColumnRange {
  std::size_t first;
  std::size_t last;  ///< behind the range
};

/// The pairs of two loops' stretches, and what it costs to go from one to the next: rows are
/// stretches of the lower loop, columns those of the upper one. Both go on for ever, round by
/// round. All is the same if the loops are exchanged, or gone through the other way round.
class PairGrid {
 public:
  /// The cost of a pair is the square of its distance and `direction_weight` times the difference
  /// of directions (1 - cosine). Keeps references to the loops.
  PairGrid(std::span<const Stretch> lower, std::span<const Stretch> upper, double direction_weight,
           double pace_weight);

  [[nodiscard]] std::size_t rows() const { return row_steps_.size(); }
  [[nodiscard]] std::size_t columns() const { return columns_; }
  [[nodiscard]] double pace_weight() const { return pace_weight_; }

  [[nodiscard]] double cost(std::size_t row, std::size_t column) const;
  /// Of a row's pairs in a range of no more than a round and a column; in `memory`, if need be.
  [[nodiscard]] const double* costs(std::size_t row, ColumnRange range,
                                    std::vector<double>& memory) const;
  /// The way from the middle of the stretch before to that of this one, as a share of its loop.
  [[nodiscard]] double row_step(std::size_t row) const { return row_steps_[row % rows()]; }
  /// Of a column and those after it, up to a round and two columns.
  [[nodiscard]] const double* column_steps(std::size_t column) const {
    return column_steps_.data() + column % columns_;
  }

  /// What a step costs between pairs with these costs: their mean over the ways along both loops,
  /// and the pace's weight over what one way is longer than the other.
  [[nodiscard]] double step_both(double a, double b, double row_step, double column_step) const {
    const double difference = row_step - column_step;
    return (a + b) / 2 * (row_step + column_step) +
           pace_weight_ * (difference < 0 ? -difference : difference);
  }
  [[nodiscard]] double step_one(double a, double b, double step) const {
    return step * ((a + b) / 2 + pace_weight_);
  }

 private:
  std::span<const Stretch> lower_;
  std::span<const Stretch> upper_;
  double direction_weight_;
  double pace_weight_;
  std::size_t columns_;
  std::vector<double> row_steps_;
  std::vector<double> column_steps_;  // of two rounds
  std::vector<double> table_;         // of all costs, if there are not too many, of two rounds
};

/// What courses cost at least from a pair on: they go through each row and each column, and pay for
/// either by itself.
class CostToCome {
 public:
  explicit CostToCome(const PairGrid& grid);

  /// From a row of the first round on, to its end.
  [[nodiscard]] double of_rows(std::size_t row) const { return of_rows_[row]; }
  /// From a column on, to one that is at most a round later.
  [[nodiscard]] double of_columns(std::size_t column, std::size_t end) const {
    return of_columns_[column] - of_columns_[end];
  }

 private:
  std::vector<double> of_rows_;
  std::vector<double> of_columns_;  // of two rounds
};

/// False if no course costs less than `most` of those that start in some columns of row 0, no more
/// than there are, and stay in given ranges. A lower bound (as if each could end where any other
/// does), that of one column is exact. Cost: that of the pairs in the ranges, or of some of them.
[[nodiscard]] bool may_cost_less(const PairGrid& grid, ColumnRange starts,
                                 std::span<const ColumnRange> ranges, const CostToCome& to_come,
                                 double most);

/// All courses once round both loops, from a pair to the same one a round later, that stay in given
/// ranges: what the least costs, and through which pairs it goes.
class Courses {
 public:
  /// Starts at the first range's first column; the last range ends one round later. Keeps a
  /// reference to the grid. Precondition: ranges of rows that follow each other overlap, or lie
  /// beside each other. Cost: that of the pairs in the ranges.
  Courses(const PairGrid& grid, std::size_t first_row, std::vector<ColumnRange> ranges);
  /// The same from row 0 on, which is left once no course can cost less than `most`.
  Courses(const PairGrid& grid, std::vector<ColumnRange> ranges, const CostToCome& to_come,
          double most);

  /// False if that was left.
  [[nodiscard]] bool is_found() const { return is_found_; }
  /// What the least course costs.
  [[nodiscard]] double least() const { return forward_.back(); }
  /// The columns of one of the least courses, row after row.
  [[nodiscard]] std::vector<ColumnRange> course() const;
  /// Of some rows, counted from the first, the columns of all least courses, where no more than
  /// `rounding` counts as the same. `take(row, column)` for each.
  template <typename Take>
  void for_each_least(std::size_t from, std::size_t to, double rounding, Take&& take) const {
    const std::vector<double> backward = fill_backward();
    for (std::size_t i = from; i < to; ++i)
      for (std::size_t k = starts_[i]; k < starts_[i + 1]; ++k)
        if (forward_[k] + backward[k] <= least() + rounding)
          take(first_row_ + i, ranges_[i].first + k - starts_[i]);
  }

 private:
  void fill_forward(const CostToCome* to_come, double most);
  [[nodiscard]] double least_through(std::size_t i, const CostToCome& to_come) const;
  [[nodiscard]] std::vector<double> fill_backward() const;

  const PairGrid& grid_;
  std::size_t first_row_;
  std::vector<ColumnRange> ranges_;
  std::vector<std::size_t> starts_;  // of each row in forward_
  std::vector<double> forward_;      // the least cost from the start, by pairs
  bool is_found_ = true;
};

}  // namespace loft
