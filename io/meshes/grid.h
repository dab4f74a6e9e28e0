// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "mesh/mesh.h"

namespace loft::io {

/// Places in a box, rounded to a grid that is the same along all axes and has 16 bits for each: to
/// half a step. Equal places stay equal.
class Grid {
 public:
  using Cell = std::array<std::uint16_t, 3>;
  static constexpr std::uint16_t last = 0xffff;

  Grid(const Vec3& low, const Vec3& high);

  /// Levels at which most places lie, from low to high, along the second axis. Where they lie
  /// evenly, their numbers get the same lower byte, which packs to nothing: the step divides their
  /// gap, and is less than twice as long for that.
  void fit(std::span<const double> levels, double high);

  [[nodiscard]] Cell cell(const Vec3& place) const;
  [[nodiscard]] Vec3 place(const Cell& cell) const;

  [[nodiscard]] const Vec3& low() const { return low_; }
  [[nodiscard]] double step() const { return step_; }

 private:
  Vec3 low_;
  double step_;
};

}  // namespace loft::io
