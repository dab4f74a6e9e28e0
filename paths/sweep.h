// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "cdt/triangulation.h"
#include "paths/gaps.h"

namespace loft::paths {

/// Whether a disc can move along a straight line. The memory of it, for one thread at a time.
class Sweep {
 public:
  /// Whether nothing that blocks the way is nearer than the radius to the segment, but for
  /// rounding: about 1e-12 of the radius, and a few units in the last place of the coordinates.
  /// `near`: an edge to look for the start from. Cost: the triangles that the disc meets on its
  /// way.
  [[nodiscard]] bool is_clear(const Gaps& gaps, cdt::Point from, cdt::Point to, double radius,
                              cdt::EdgeId near);

 private:
  std::vector<std::uint32_t> seen_;  // by triangle: in which sweep
  std::uint32_t sweep_ = 0;
  std::vector<cdt::TriangleId> front_;
};

}  // namespace loft::paths
