// SPDX-License-Identifier: MIT
#pragma once

#include <utility>
#include <vector>

#include "cdt/point.h"
#include "reconstruct/plane/segment_tree.h"

namespace loft {

/// Finds the distance from a point in the plane to the nearest of a fixed set of segments.
class NearestSegment {
 public:
  NearestSegment() = default;
  /// Cost: O(n log n).
  explicit NearestSegment(std::vector<Segment> segments) : tree_(std::move(segments)) {}

  [[nodiscard]] bool is_empty() const { return tree_.is_empty(); }
  /// Infinite if there are no segments. Cost: O(log n) in practice.
  [[nodiscard]] double distance(cdt::Point p) const;

 private:
  SegmentTree tree_;
};

/// The foot of p on the segment ab; exactly a or b where it is an end.
[[nodiscard]] cdt::Point foot(cdt::Point p, cdt::Point a, cdt::Point b);

/// The distance from p to the segment ab.
[[nodiscard]] double distance(cdt::Point p, cdt::Point a, cdt::Point b);

}  // namespace loft
