// SPDX-License-Identifier: MIT
#include "reconstruct/registration/matching.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "cdt/effort.h"

namespace loft {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Sums that differ by no more than that share are the same but for rounding: then what comes first
/// is taken, so that it does not depend on how the loops are turned.
constexpr double rounding = 1e-9;

bool is_less(double a, double b) { return a < b - rounding * a; }

struct Costs {
  double direction_weight;

  double operator()(const Stretch& a, const Stretch& b) const {
    const double x = b.middle.x - a.middle.x;
    const double y = b.middle.y - a.middle.y;
    const double cosine = a.normal.x * b.normal.x + a.normal.y * b.normal.y;
    return x * x + y * y + direction_weight * (1 - cosine);
  }
};

/// Which way a course came to a pair.
enum class Step : std::uint8_t { both, lower, upper };

/// Columns of a row: of a stretch of the lower loop, those of the upper one that are looked at.
struct Range {
  std::size_t first;
  std::size_t last;  // behind the range
};

/// What all rows after one cost at least, and all columns after one: a course goes through each of
/// them, and pays for a row and for a column by itself.
struct Rest {
  const double* of_rows;
  const double* of_columns;
};

/// The least course through both loops from a pair to the one before it, once round. Rows are
/// stretches of the lower loop, columns of the upper one, both counted from where it starts.
class Course {
 public:
  Course(std::size_t columns, double pace_weight) : pace_weight_(pace_weight), columns_(columns) {}

  /// Its cost; none once no course can cost less than `least`. `costs(row)` are those of the row's
  /// range. Precondition: ranges overlap from row to row; the first begins with 0, the last ends at
  /// the end.
  template <typename CostsOfRow>
  std::optional<double> find(std::span<const Range> ranges, CostsOfRow&& costs, double least,
                             const Rest& rest) {
    ranges_.assign(ranges.begin(), ranges.end());
    starts_.assign(1, 0);
    for (const Range range : ranges) starts_.push_back(starts_.back() + range.last - range.first);
    steps_.resize(starts_.back());
    before_.assign(columns_ + 1, infinity);
    row_.assign(columns_ + 1, infinity);
    before_[0] = 0;
    for (std::size_t i = 0; i < ranges.size(); ++i) {
      cdt::spend(1 + (ranges[i].last - ranges[i].first) / cells_of_step);
      fill(i, costs(i));
      if (least_in_all(i, rest.of_columns) + rest.of_rows[i] >= least) return {};
    }
    return before_[columns_];
  }

  /// The pairs of the course that was found last, back from the end.
  [[nodiscard]] std::vector<Match> pairs() const {
    std::vector<Match> found;
    std::size_t i = ranges_.size() - 1;
    std::size_t j = columns_ - 1;
    while (true) {
      found.push_back({static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j)});
      if (i == 0 && j == 0) return found;
      const Step step = steps_[starts_[i] + j - ranges_[i].first];
      if (step != Step::upper) --i;
      if (step != Step::lower) --j;
    }
  }

 private:
  /// About as many take as long as a test of two triangles.
  static constexpr std::size_t cells_of_step = 16;

  /// Row i, from that before it; the least in it. A step costs what it leads to, by the length that
  /// it goes. Column j is at j + 1: the start comes from before all, diagonally and for nothing.
  void fill(std::size_t i, const double* costs) {
    const auto [first, last] = ranges_[i];
    Step* const steps = steps_.data() + starts_[i];
    const double* const above = before_.data() + first;
    double* const row = row_.data() + first + 1;
    for (std::size_t k = 0; k < last - first; ++k) {
      const double both = above[k] + 2 * costs[k];
      const double lower = above[k + 1] + costs[k] + pace_weight_;
      const bool is_lower = is_less(lower, both);
      row[k] = is_lower ? lower : both;
      steps[k] = is_lower ? Step::lower : Step::both;
    }
    double left = infinity;  // of the pair before in this row
    for (std::size_t k = 0; k < last - first; ++k) {
      const double upper = left + costs[k] + pace_weight_;
      left = row[k];
      if (is_less(upper, left)) {
        row[k] = left = upper;
        steps[k] = Step::upper;
      }
    }
    std::swap(row_, before_);
    const std::size_t from = i == 0 ? 0 : ranges_[i - 1].first;
    const std::size_t to = i == 0 ? 1 : ranges_[i - 1].last + 1;
    std::fill(row_.begin() + static_cast<std::ptrdiff_t>(from),
              row_.begin() + static_cast<std::ptrdiff_t>(to), infinity);
  }

  /// What a course through row i costs at least, but for the rows after it.
  [[nodiscard]] double least_in_all(std::size_t i, const double* rest_of_columns) const {
    double least = infinity;
    for (std::size_t j = ranges_[i].first; j < ranges_[i].last; ++j)
      least = std::min(least, before_[j + 1] + rest_of_columns[j]);
    return least;
  }

  double pace_weight_;
  std::size_t columns_;
  std::vector<Range> ranges_;
  std::vector<std::size_t> starts_;  // of each row in steps_
  std::vector<Step> steps_;
  std::vector<double> before_;
  std::vector<double> row_;
};

/// Some of a loop's stretches, at equal distances along it, each for all that are nearest to it.
struct Sample {
  std::vector<Stretch> stretches;
  std::vector<std::size_t> original;
};

Sample sample(std::span<const Stretch> loop, std::size_t count) {
  Sample made;
  double whole = 0;
  for (const Stretch& stretch : loop) whole += stretch.length;
  const double step = whole / static_cast<double>(std::min(count, loop.size()));
  double next = step / 2;
  double way = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    way += loop[i].length;
    if (way < next && !(i + 1 == loop.size() && made.stretches.empty())) continue;
    made.stretches.push_back(loop[i]);
    made.stretches.back().length = step;
    made.original.push_back(i);
    while (next <= way) next += step;
  }
  return made;
}

/// The pair that the coarse course is surest of, and the ranges of the fine one around it.
struct Band {
  std::size_t lower_start;
  std::size_t upper_start;
  std::vector<Range> ranges;
};

/// Pairs of a coarse course, turned so that the cheapest comes first, in the order of the course.
std::vector<Match> from_cheapest(std::vector<Match> course, const Sample& lower,
                                 const Sample& upper, Costs costs) {
  std::ranges::reverse(course);
  const auto cost = [&](const Match& match) {
    return costs(lower.stretches[match.lower], upper.stretches[match.upper]);
  };
  const double least = cost(*std::ranges::min_element(course, {}, cost));
  const double same = least + rounding * (least + costs.direction_weight);
  const auto first =
      std::ranges::find_if(course, [&](const Match& match) { return cost(match) <= same; });
  std::rotate(course.begin(), first, course.end());
  return course;
}

Band band(const std::vector<Match>& course, const Sample& lower, const Sample& upper,
          std::size_t lower_size, std::size_t upper_size) {
  // How many coarse places a fine course may stray.
  constexpr std::size_t slack = 4;
  Band made{lower.original[course.front().lower], upper.original[course.front().upper], {}};
  const auto place = [](std::size_t original, std::size_t start, std::size_t size) {
    return (original + size - start) % size;
  };
  const std::size_t reach = slack * (upper_size / upper.stretches.size() + 1);
  const std::size_t lower_reach = slack * (lower_size / lower.stretches.size() + 1) / 2;
  made.ranges.assign(lower_size, {upper_size, 0});
  const auto cover = [&](std::size_t i, std::size_t j) {
    Range& range = made.ranges[i];
    range.first = std::min(range.first, j > reach ? j - reach : 0);
    range.last = std::max(range.last, std::min(upper_size, j + reach + 1));
  };
  std::size_t i = 0;
  std::size_t j = 0;
  const auto go_to = [&](std::size_t next_i, std::size_t next_j) {
    const std::size_t steps = std::max<std::size_t>(1, next_i - i);
    for (std::size_t s = 0; s <= steps && i + s < lower_size; ++s) {
      cover(i + s, j + (next_j - j) * s / steps);
      cover(i + s, std::min(next_j, j + (next_j - j) * (s + 1) / steps));
    }
    i = next_i;
    j = next_j;
  };
  for (const Match& match : course) {
    const std::size_t next_i = place(lower.original[match.lower], made.lower_start, lower_size);
    const std::size_t next_j = place(upper.original[match.upper], made.upper_start, upper_size);
    if (next_i >= i && next_j >= j) go_to(next_i, next_j);
  }
  go_to(lower_size - 1, upper_size - 1);
  // Wider by rows, too, and one after the other.
  std::vector<Range> wide = made.ranges;
  for (std::size_t row = 0; row < lower_size; ++row) {
    const std::size_t from = row > lower_reach ? row - lower_reach : 0;
    const std::size_t to = std::min(lower_size - 1, row + lower_reach);
    wide[row].first = std::min(made.ranges[from].first, made.ranges[row].first);
    wide[row].last = std::max(made.ranges[to].last, made.ranges[row].last);
  }
  wide.front().first = 0;
  wide.back().last = upper_size;
  made.ranges = std::move(wide);
  return made;
}

/// All costs between two loops' places.
class CostTable {
 public:
  CostTable(std::span<const Stretch> lower, std::span<const Stretch> upper, Costs costs)
      : rows_(lower.size()), columns_(upper.size()), least_of_columns_(columns_, infinity) {
    for (const Stretch& a : lower) {
      const auto first = static_cast<std::ptrdiff_t>(costs_.size());
      for (std::size_t j = 0; j < columns_; ++j) {
        costs_.push_back(costs(a, upper[j]));
        least_of_columns_[j] = std::min(least_of_columns_[j], costs_.back());
      }
      least_of_rows_.push_back(*std::min_element(costs_.begin() + first, costs_.end()));
      // Once more, to go round from any of them.
      for (std::size_t j = 0; j < columns_; ++j) costs_.push_back(costs_[costs_.size() - columns_]);
    }
    rest_of_rows_.resize(rows_);
    rest_of_columns_.resize(columns_);
  }

  /// The costs of row i from a column on, once round.
  [[nodiscard]] const double* row(std::size_t i, std::size_t start) const {
    return costs_.data() + 2 * columns_ * i + start;
  }

  /// For courses from that column on.
  [[nodiscard]] Rest rest(std::size_t start) {
    for (std::size_t i = rows_ - 1; i > 0; --i)
      rest_of_rows_[i - 1] = rest_of_rows_[i] + least_of_rows_[i];
    for (std::size_t j = columns_ - 1; j > 0; --j)
      rest_of_columns_[j - 1] = rest_of_columns_[j] + least_of_columns_[(start + j) % columns_];
    return {rest_of_rows_.data(), rest_of_columns_.data()};
  }

 private:
  std::size_t rows_;
  std::size_t columns_;
  std::vector<double> costs_;
  std::vector<double> least_of_rows_;
  std::vector<double> least_of_columns_;
  std::vector<double> rest_of_rows_;
  std::vector<double> rest_of_columns_;
};

/// The least course between all places, wherever it starts, back from its end.
std::vector<Match> find_coarse(std::span<const Stretch> lower, std::span<const Stretch> upper,
                               Costs costs, double pace_weight) {
  // A cost may be below 0 by rounding.
  constexpr double below_zero = 1e-12;
  const std::size_t columns = upper.size();
  CostTable table(lower, upper, costs);
  const std::vector<Range> all(lower.size(), {0, columns});
  Course course(columns, pace_weight);
  double least = infinity;
  std::vector<Match> best;
  for (std::size_t start = 0; start < columns; ++start) {
    const auto costs_of_row = [&](std::size_t i) { return table.row(i, start); };
    const double bound = least + below_zero * costs.direction_weight;
    const auto cost = course.find(all, costs_of_row, bound, table.rest(start));
    if (!cost || !is_less(*cost, least)) continue;
    least = *cost;
    best = course.pairs();
    for (Match& match : best)
      match.upper = static_cast<std::uint32_t>((match.upper + start) % columns);
  }
  return best;
}

/// The least course between all stretches in a band, back from its end.
std::vector<Match> find_fine(std::span<const Stretch> lower, std::span<const Stretch> upper,
                             Costs costs, double pace_weight, const Band& band) {
  std::vector<double> row;
  const auto costs_of_row = [&](std::size_t i) {
    const Stretch& a = lower[(band.lower_start + i) % lower.size()];
    row.clear();
    for (std::size_t j = band.ranges[i].first; j < band.ranges[i].last; ++j)
      row.push_back(costs(a, upper[(band.upper_start + j) % upper.size()]));
    return row.data();
  };
  Course course(upper.size(), pace_weight);
  const std::vector<double> none(std::max(lower.size(), upper.size()));
  course.find(band.ranges, costs_of_row, infinity, {none.data(), none.data()});
  std::vector<Match> pairs = course.pairs();
  for (auto& [i, j] : pairs) {
    i = static_cast<std::uint32_t>((i + band.lower_start) % lower.size());
    j = static_cast<std::uint32_t>((j + band.upper_start) % upper.size());
  }
  return pairs;
}

}  // namespace

std::vector<Match> match_outlines(std::span<const Stretch> lower, std::span<const Stretch> upper,
                                  double direction_weight, double pace_weight, std::size_t coarse) {
  const Costs costs{direction_weight};
  const Sample below = sample(lower, coarse);
  const Sample above = sample(upper, coarse);
  const std::vector<Match> course = from_cheapest(
      find_coarse(below.stretches, above.stretches, costs, pace_weight), below, above, costs);
  return find_fine(lower, upper, costs, pace_weight,
                   band(course, below, above, lower.size(), upper.size()));
}

}  // namespace loft
