// SPDX-License-Identifier: MIT
#include "io/contours/heights.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace loft::io {

namespace {

constexpr double rounding = 1e-6;  // of the largest height: floats have 6e-8
constexpr double share_of_gap = 0.01;

/// The lower median gap between sorted heights; 0 if all are the same.
double median_gap(const std::vector<double>& sorted) {
  std::vector<double> gaps;
  for (std::size_t i = 1; i < sorted.size(); ++i)
    if (sorted[i] > sorted[i - 1]) gaps.push_back(sorted[i] - sorted[i - 1]);
  if (gaps.empty()) return 0;
  std::ranges::sort(gaps);
  const double least = rounding * std::max(std::abs(sorted.front()), std::abs(sorted.back()));
  auto first = std::ranges::upper_bound(gaps, least);
  if (first == gaps.end()) first = gaps.begin();
  return *(first + (gaps.end() - first - 1) / 2);
}

/// The value that comes most often in a sorted range, the first of these.
double most_frequent(std::vector<double>::const_iterator begin,
                     std::vector<double>::const_iterator end) {
  double best = *begin;
  std::ptrdiff_t most = 0;
  while (begin != end) {
    const auto next = std::upper_bound(begin, end, *begin);
    if (next - begin > most) best = *begin;
    most = std::max(most, next - begin);
    begin = next;
  }
  return best;
}

}  // namespace

HeightGroups::HeightGroups(std::vector<double> heights) {
  std::ranges::sort(heights);
  tolerance_ = share_of_gap * median_gap(heights);
  const auto end = heights.cend();
  for (auto begin = heights.cbegin(); begin != end;) {
    const auto next = std::find_if(begin, end, [&](double z) { return z - *begin > tolerance_; });
    groups_.push_back({*begin, *(next - 1), most_frequent(begin, next)});
    begin = next;
  }
}

double HeightGroups::of(double height) const {
  // The first group that does not lie below it, or its neighbour, may be near enough.
  auto next = std::ranges::lower_bound(groups_, height, {}, &Group::highest);
  const auto is_near = [&](const Group& group) {
    return height >= group.lowest - tolerance_ && height <= group.highest + tolerance_;
  };
  const auto is_in = [&](const Group& group) {
    return height >= group.lowest && height <= group.highest;
  };
  if (next != groups_.end() && is_in(*next)) return next->height;
  if (next != groups_.begin() && is_near(*(next - 1))) return (next - 1)->height;
  if (next != groups_.end() && is_near(*next)) return next->height;
  return height;
}

}  // namespace loft::io
