// SPDX-License-Identifier: MIT
#include "io/meshes/grid.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "mesh/vec3.h"

namespace loft::io {

namespace {

/// The distance of levels that lie evenly, but for a hundredth of it; 0 where they do not.
double even_gap(std::span<const double> levels) {
  constexpr double tolerance = 0.01;
  if (levels.size() < 3) return 0;
  double least = levels[1] - levels[0];
  for (std::size_t i = 2; i < levels.size(); ++i)
    least = std::min(least, levels[i] - levels[i - 1]);
  const double height = levels.back() - levels.front();
  const double gap = height / std::round(height / least);
  const bool is_even = std::ranges::all_of(levels, [&](double level) {
    const double place = (level - levels.front()) / gap;
    return std::abs(place - std::round(place)) < tolerance;
  });
  return is_even ? gap : 0;
}

}  // namespace

Grid::Grid(const Vec3& low, const Vec3& high) : low_(low) {
  const Vec3 size = minus(high, low);
  step_ = *std::ranges::max_element(size) / last;
  if (!(step_ > 0)) step_ = 1;
}

void Grid::fit(std::span<const double> levels, double high) {
  constexpr double byte = 256;
  constexpr double rounding = 1e-6;
  constexpr std::size_t up = 1;
  const double gap = even_gap(levels);
  const double most = std::floor(gap / step_);
  if (!(most >= 2)) return;
  const double block = std::min(byte, std::exp2(std::floor(std::log2(most))));
  const double step = gap / (std::floor(most / block) * block);
  const double below = std::ceil((levels.front() - low_[up]) / (block * step) - rounding);
  const double low = levels.front() - below * block * step;
  if (high - low > last * step) return;
  low_[up] = low;
  step_ = step;
}

Grid::Cell Grid::cell(const Vec3& place) const {
  Cell result{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double steps = std::round((place[axis] - low_[axis]) / step_);
    result[axis] = static_cast<std::uint16_t>(std::clamp(steps, 0.0, double{last}));
  }
  return result;
}

Vec3 Grid::place(const Cell& cell) const {
  Vec3 result{};
  for (std::size_t axis = 0; axis < 3; ++axis) result[axis] = low_[axis] + step_ * cell[axis];
  return result;
}

}  // namespace loft::io
