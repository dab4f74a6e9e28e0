// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "reconstruct/slice.h"

namespace loft {

/// Looks for stairs in contours, as outlines along the edges of pixels have them.
class Stairs {
 public:
  /// Of all edges, how many are steps at least where there are stairs.
  static constexpr double least_share = 0.2;
  /// Fewer steps are no stairs.
  static constexpr std::size_t least_steps = 16;

  /// Counts a slice's edges, and its steps: edges along an axis, as long as the shortest of their
  /// contour, whose neighbours are at right angles to them and lead away to different sides.
  void add(const Slice& slice);

  [[nodiscard]] bool are_there() const {
    return steps_ >= least_steps &&
           static_cast<double>(steps_) >= least_share * static_cast<double>(edges_);
  }

 private:
  std::size_t steps_ = 0;
  std::size_t edges_ = 0;
};

}  // namespace loft
