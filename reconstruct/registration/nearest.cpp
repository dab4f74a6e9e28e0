// SPDX-License-Identifier: MIT
#include "reconstruct/registration/nearest.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "cdt/effort.h"

namespace loft {

StretchTree::StretchTree(std::span<const Stretch> stretches, double direction_weight)
    : direction_(std::sqrt(direction_weight / 2)) {
  for (const Stretch& stretch : stretches)
    items_.push_back({key(stretch), static_cast<std::uint32_t>(items_.size()), 0});
  build(0, items_.size());
}

/// Of unit vectors a and b, |a - b|^2 = 2 (1 - cosine).
StretchTree::Key StretchTree::key(const Stretch& stretch) const {
  return {stretch.middle.x, stretch.middle.y, direction_ * stretch.normal.x,
          direction_ * stretch.normal.y};
}

/// Along the axis in which the range is spread out most.
void StretchTree::build(std::size_t first, std::size_t last) {
  if (last - first < 2) return;
  const auto at = [&](std::size_t i) { return items_.begin() + static_cast<std::ptrdiff_t>(i); };
  Key low = items_[first].key;
  Key high = low;
  for (std::size_t i = first + 1; i < last; ++i) {
    for (std::size_t k = 0; k < low.size(); ++k) {
      low[k] = std::min(low[k], items_[i].key[k]);
      high[k] = std::max(high[k], items_[i].key[k]);
    }
  }
  unsigned axis = 0;
  for (unsigned k = 1; k < low.size(); ++k)
    if (high[k] - low[k] > high[axis] - low[axis]) axis = k;
  const std::size_t middle = first + (last - first) / 2;
  std::nth_element(at(first), at(middle), at(last), [&](const Item& a, const Item& b) {
    return a.key[axis] != b.key[axis] ? a.key[axis] < b.key[axis] : a.index < b.index;
  });
  items_[middle].axis = axis;
  build(first, middle);
  build(middle + 1, last);
}

void StretchTree::search(std::size_t first, std::size_t last, const Key& wanted,
                         Nearest& best) const {
  if (first == last) return;
  const std::size_t middle = first + (last - first) / 2;
  const auto& [key, index, axis] = items_[middle];
  double cost = 0;
  for (std::size_t i = 0; i < 4; ++i) cost += (key[i] - wanted[i]) * (key[i] - wanted[i]);
  if (cost < best.cost || (cost == best.cost && index < best.index)) best = {index, cost};
  const double beyond = wanted[axis] - key[axis];
  if (beyond < 0) {
    search(first, middle, wanted, best);
    if (beyond * beyond <= best.cost) search(middle + 1, last, wanted, best);
  } else {
    search(middle + 1, last, wanted, best);
    if (beyond * beyond <= best.cost) search(first, middle, wanted, best);
  }
}

StretchTree::Nearest StretchTree::nearest(const Stretch& stretch) const {
  cdt::spend();
  Nearest best{Origin::none, std::numeric_limits<double>::infinity()};
  search(0, items_.size(), key(stretch), best);
  assert(best.index != Origin::none);
  return best;
}

/// As with equal ones it is rounding that says which is the first, all are taken: so what is made
/// of them does not depend on how they are turned.
void StretchTree::all_nearest(const Stretch& stretch, std::vector<std::uint32_t>& found) const {
  constexpr double rounding = 1e-9;
  constexpr std::size_t found_of_step = 16;
  const double least = nearest(stretch).cost;
  found.clear();
  gather(0, items_.size(), key(stretch), least + rounding * (least + direction_ * direction_),
         found);
  cdt::spend(1 + found.size() / found_of_step);
}

void StretchTree::gather(std::size_t first, std::size_t last, const Key& wanted, double most,
                         std::vector<std::uint32_t>& found) const {
  if (first == last) return;
  const std::size_t middle = first + (last - first) / 2;
  const auto& [key, index, axis] = items_[middle];
  double cost = 0;
  for (std::size_t i = 0; i < 4; ++i) cost += (key[i] - wanted[i]) * (key[i] - wanted[i]);
  if (cost <= most) found.push_back(index);
  const double beyond = wanted[axis] - key[axis];
  const bool is_across = beyond * beyond <= most;
  if (beyond < 0 || is_across) gather(first, middle, wanted, most, found);
  if (beyond >= 0 || is_across) gather(middle + 1, last, wanted, most, found);
}

std::vector<Match> match_nearest(std::span<const Stretch> lower, std::span<const Stretch> upper,
                                 double direction_weight) {
  const StretchTree below(lower, direction_weight);
  const StretchTree above(upper, direction_weight);
  std::vector<Match> found;
  std::vector<std::uint32_t> nearest;
  for (std::uint32_t i = 0; i < lower.size(); ++i) {
    above.all_nearest(lower[i], nearest);
    for (const std::uint32_t j : nearest) found.push_back({i, j});
  }
  for (std::uint32_t j = 0; j < upper.size(); ++j) {
    below.all_nearest(upper[j], nearest);
    for (const std::uint32_t i : nearest) found.push_back({i, j});
  }
  return found;
}

double mean_square_distance(std::span<const Stretch> lower, std::span<const Stretch> upper) {
  const auto mean = [](std::span<const Stretch> from, std::span<const Stretch> to) {
    const StretchTree tree(to, 0);
    double sum = 0;
    double length = 0;
    for (const Stretch& stretch : from) {
      sum += stretch.length * tree.nearest(stretch).cost;
      length += stretch.length;
    }
    return sum / length;
  };
  return std::max(mean(lower, upper), mean(upper, lower));
}

}  // namespace loft
