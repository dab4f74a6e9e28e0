// SPDX-License-Identifier: MIT
#include "reconstruct/registration/matching.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace loft {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Sums that differ by no more than that share are the same but for rounding: then what comes first
/// is taken, so that it does not depend on how the loops are turned.
constexpr double rounding = 1e-9;

bool is_less(double a, double b) { return a < b - rounding * a; }

struct Costs {
  double direction_weight;
  double pace_weight;

  double operator()(const Stretch& a, const Stretch& b) const {
    const double x = b.middle.x - a.middle.x;
    const double y = b.middle.y - a.middle.y;
    const double cosine = a.normal.x * b.normal.x + a.normal.y * b.normal.y;
    return x * x + y * y + direction_weight * (1 - cosine);
  }
};

/// Which way a course came to a pair.
enum class Step : std::uint8_t { both, lower, upper };

/// The least course through both loops from a pair that is given, round to it again. Rows are
/// stretches of the lower loop, columns of the upper one; only columns in a row's range are looked
/// at.
class Course {
 public:
  struct Range {
    std::size_t first;
    std::size_t last;  // behind the range
  };

  Course(std::span<const Stretch> lower, std::span<const Stretch> upper, Costs costs)
      : lower_(lower), upper_(upper), costs_(costs) {}

  /// Its cost. Precondition: ranges overlap from row to row; the first begins with 0, the last ends
  /// at the end.
  double find(std::size_t lower_start, std::size_t upper_start, std::span<const Range> ranges) {
    lower_start_ = lower_start;
    upper_start_ = upper_start;
    ranges_.assign(ranges.begin(), ranges.end());
    starts_.assign(1, 0);
    for (const Range range : ranges) starts_.push_back(starts_.back() + range.last - range.first);
    steps_.resize(starts_.back());
    before_.assign(upper_.size(), infinity);
    row_.assign(upper_.size(), infinity);
    for (std::size_t i = 0; i < lower_.size(); ++i) fill(i);
    return before_[upper_.size() - 1];
  }

  /// The pairs of the course that was found last, back from the end.
  [[nodiscard]] std::vector<Match> pairs() const {
    std::vector<Match> found;
    std::size_t i = lower_.size() - 1;
    std::size_t j = upper_.size() - 1;
    while (true) {
      found.push_back(
          {static_cast<std::uint32_t>(lower_index(i)), static_cast<std::uint32_t>(upper_index(j))});
      if (i == 0 && j == 0) return found;
      const Step step = steps_[starts_[i] + j - ranges_[i].first];
      if (step != Step::upper) --i;
      if (step != Step::lower) --j;
    }
  }

 private:
  [[nodiscard]] std::size_t lower_index(std::size_t i) const {
    return (lower_start_ + i) % lower_.size();
  }
  [[nodiscard]] std::size_t upper_index(std::size_t j) const {
    return (upper_start_ + j) % upper_.size();
  }

  /// Row i, from that before it. A step costs what it leads to, by the length that it goes.
  void fill(std::size_t i) {
    const Stretch& a = lower_[lower_index(i)];
    const auto [first, last] = ranges_[i];
    double left = infinity;  // of the pair before in this row
    for (std::size_t j = first; j < last; ++j) {
      const Stretch& b = upper_[upper_index(j)];
      const double cost = costs_(a, b);
      double best = i == 0 && j == 0 ? 2 * cost : infinity;
      Step step = Step::both;
      if (i > 0 && j > 0 && before_[j - 1] + 2 * cost < best) best = before_[j - 1] + 2 * cost;
      if (i > 0 && is_less(before_[j] + cost + costs_.pace_weight, best)) {
        best = before_[j] + cost + costs_.pace_weight;
        step = Step::lower;
      }
      if (is_less(left + cost + costs_.pace_weight, best)) {
        best = left + cost + costs_.pace_weight;
        step = Step::upper;
      }
      row_[j] = left = best;
      steps_[starts_[i] + j - first] = step;
    }
    std::swap(row_, before_);
    const std::size_t from = i == 0 ? 0 : ranges_[i - 1].first;
    const std::size_t to = i == 0 ? 0 : ranges_[i - 1].last;
    std::fill(row_.begin() + static_cast<std::ptrdiff_t>(from),
              row_.begin() + static_cast<std::ptrdiff_t>(to), infinity);
  }

  std::span<const Stretch> lower_;
  std::span<const Stretch> upper_;
  Costs costs_;
  std::size_t lower_start_ = 0;
  std::size_t upper_start_ = 0;
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
  std::vector<Course::Range> ranges;
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
  std::ranges::rotate(course, std::ranges::find_if(
                                  course, [&](const Match& match) { return cost(match) <= same; }));
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
    Course::Range& range = made.ranges[i];
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
  std::vector<Course::Range> wide = made.ranges;
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

}  // namespace

std::vector<Match> match_outlines(std::span<const Stretch> lower, std::span<const Stretch> upper,
                                  double direction_weight, double pace_weight, std::size_t coarse) {
  const Costs costs{direction_weight, pace_weight};
  const Sample below = sample(lower, coarse);
  const Sample above = sample(upper, coarse);
  const std::size_t rows = below.stretches.size();
  const std::size_t columns = above.stretches.size();
  Course rough(below.stretches, above.stretches, costs);
  const std::vector<Course::Range> all(rows, {0, columns});
  double least = infinity;
  std::vector<Match> best;
  for (std::size_t start = 0; start < columns; ++start) {
    const double cost = rough.find(0, start, all);
    if (!is_less(cost, least)) continue;
    least = cost;
    best = rough.pairs();
  }
  best = from_cheapest(std::move(best), below, above, costs);
  const Band near = band(best, below, above, lower.size(), upper.size());
  Course fine(lower, upper, costs);
  fine.find(near.lower_start, near.upper_start, near.ranges);
  return fine.pairs();
}

}  // namespace loft
