// SPDX-License-Identifier: MIT
#include "reconstruct/registration/nearest.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cdt/effort.h"

namespace loft {

StretchTree::StretchTree(std::span<const Stretch> stretches, double direction_weight)
    : direction_(std::sqrt(direction_weight / 2)) {
  for (const Stretch& stretch : stretches)
    items_.push_back({key(stretch), static_cast<std::uint32_t>(items_.size())});
  build(0, items_.size(), 0);
}

/// Of unit vectors a and b, |a - b|^2 = 2 (1 - cosine).
StretchTree::Key StretchTree::key(const Stretch& stretch) const {
  return {stretch.middle.x, stretch.middle.y, direction_ * stretch.normal.x,
          direction_ * stretch.normal.y};
}

void StretchTree::build(std::size_t first, std::size_t last, unsigned axis) {
  if (last - first < 2) return;
  const std::size_t middle = first + (last - first) / 2;
  const auto at = [&](std::size_t i) { return items_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(first), at(middle), at(last), [&](const Item& a, const Item& b) {
    return a.key[axis] != b.key[axis] ? a.key[axis] < b.key[axis] : a.index < b.index;
  });
  build(first, middle, (axis + 1) % 4);
  build(middle + 1, last, (axis + 1) % 4);
}

void StretchTree::search(std::size_t first, std::size_t last, unsigned axis, const Key& wanted,
                         Nearest& best) const {
  if (first == last) return;
  cdt::spend();
  const std::size_t middle = first + (last - first) / 2;
  const auto& [key, index] = items_[middle];
  double cost = 0;
  for (std::size_t i = 0; i < 4; ++i) cost += (key[i] - wanted[i]) * (key[i] - wanted[i]);
  if (cost < best.cost || (cost == best.cost && index < best.index)) best = {index, cost};
  const double beyond = wanted[axis] - key[axis];
  const unsigned next = (axis + 1) % 4;
  if (beyond < 0) {
    search(first, middle, next, wanted, best);
    if (beyond * beyond <= best.cost) search(middle + 1, last, next, wanted, best);
  } else {
    search(middle + 1, last, next, wanted, best);
    if (beyond * beyond <= best.cost) search(first, middle, next, wanted, best);
  }
}

StretchTree::Nearest StretchTree::nearest(const Stretch& stretch) const {
  Nearest best{Origin::none, std::numeric_limits<double>::infinity()};
  search(0, items_.size(), 0, key(stretch), best);
  return best;
}

std::vector<Match> match_nearest(std::span<const Stretch> lower, std::span<const Stretch> upper,
                                 double direction_weight) {
  const StretchTree below(lower, direction_weight);
  const StretchTree above(upper, direction_weight);
  std::vector<Match> found;
  for (std::uint32_t i = 0; i < lower.size(); ++i)
    found.push_back({i, above.nearest(lower[i]).index});
  for (std::uint32_t i = 0; i < upper.size(); ++i)
    found.push_back({below.nearest(upper[i]).index, i});
  return found;
}

double mean_square_distance(std::span<const Stretch> lower, std::span<const Stretch> upper) {
  const auto mean = [](std::span<const Stretch> from, std::span<const Stretch> to) {
    const StretchTree tree(to, 0);
    double sum = 0;
    for (const Stretch& stretch : from) sum += tree.nearest(stretch).cost;
    return sum / static_cast<double>(from.size());
  };
  return std::max(mean(lower, upper), mean(upper, lower));
}

}  // namespace loft
