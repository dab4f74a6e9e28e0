// SPDX-License-Identifier: MIT
#include "io/gltf/grid.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "mesh/vec3.h"

namespace loft::io {

Grid::Grid(const Vec3& low, const Vec3& high) : low_(low) {
  const Vec3 size = minus(high, low);
  step_ = *std::ranges::max_element(size) / last;
  if (!(step_ > 0)) step_ = 1;
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
