// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "cdt/point.h"

namespace loft {

/// Finds the distance from a point in the plane to the nearest of a fixed set of segments.
class NearestSegment {
 public:
  using Segment = std::array<cdt::Point, 2>;

  NearestSegment() = default;
  /// Cost: O(n log n).
  explicit NearestSegment(std::vector<Segment> segments);

  [[nodiscard]] bool is_empty() const { return segments_.empty(); }
  /// Infinite if there are no segments. Cost: O(log n) in practice.
  [[nodiscard]] double distance(cdt::Point p) const;

 private:
  struct Node {
    cdt::Box box;
    std::uint32_t first;  // leaf: its segments are first ... first + count - 1
    std::uint32_t count;  // inner: 0; children are the next node and node `first`
  };

  void build(std::uint32_t first, std::uint32_t last);

  std::vector<Segment> segments_;
  std::vector<Node> nodes_;
};

/// The distance from p to the segment ab.
[[nodiscard]] double distance(cdt::Point p, cdt::Point a, cdt::Point b);

}  // namespace loft
