// SPDX-License-Identifier: MIT
// For sources of io/gltf only.
#pragma once

#include <array>
#include <cstdint>

#include "mesh/mesh.h"

namespace loft::io {

/// Places in a box, rounded to a grid that is the same along all axes and has 16 bits for each: to
/// half a step. Equal places stay equal.
class Grid {
 public:
  using Cell = std::array<std::uint16_t, 3>;
  static constexpr std::uint16_t last = 0xffff;

  Grid(const Vec3& low, const Vec3& high);

  [[nodiscard]] Cell cell(const Vec3& place) const;
  [[nodiscard]] Vec3 place(const Cell& cell) const;

  [[nodiscard]] const Vec3& low() const { return low_; }
  [[nodiscard]] double step() const { return step_; }

 private:
  Vec3 low_;
  double step_;
};

}  // namespace loft::io
