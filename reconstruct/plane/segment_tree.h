// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "cdt/point.h"

namespace loft {

/// A segment in the plane, from its first end to its second.
using Segment = std::array<cdt::Point, 2>;

/// A fixed set of segments in the plane, in a tree of boxes, to find those near a place.
class SegmentTree {
 public:
  SegmentTree() = default;
  /// Cost: O(n log n).
  explicit SegmentTree(std::vector<Segment> segments);

  [[nodiscard]] bool is_empty() const { return segments_.empty(); }

  /// Visits segments near p, nearer boxes first: `visit(segment)` returns the square of the
  /// distance beyond which nothing matters any more; `limit` is that at the beginning. All segments
  /// within it are visited. Cost: O(log n) in practice.
  template <class Visit>
  void visit_near(cdt::Point p, double limit, Visit visit) const {
    std::array<std::uint32_t, most_levels> stack;
    std::size_t depth = 0;
    if (!nodes_.empty()) stack[depth++] = 0;
    while (depth != 0) {
      const std::uint32_t self = stack[--depth];
      const Node& node = nodes_[self];
      if (squared_distance(p, node.box) > limit) continue;
      if (node.count == 0) {
        std::uint32_t near = self + 1;
        std::uint32_t far = node.first;
        if (squared_distance(p, nodes_[far].box) < squared_distance(p, nodes_[near].box))
          std::swap(near, far);
        stack[depth++] = far;
        stack[depth++] = near;
        continue;
      }
      for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
        limit = visit(segments_[i]);
    }
  }

 private:
  /// More levels than any tree has whose nodes are halved.
  static constexpr std::size_t most_levels = 64;

  struct Node {
    cdt::Box box;
    std::uint32_t first;  // leaf: its segments are first ... first + count - 1
    std::uint32_t count;  // inner: 0; children are the next node and node `first`
  };

  static double squared_distance(cdt::Point p, const cdt::Box& box) {
    const double dx = std::max({box.low.x - p.x, p.x - box.high.x, 0.0});
    const double dy = std::max({box.low.y - p.y, p.y - box.high.y, 0.0});
    return dx * dx + dy * dy;
  }
  void build(std::uint32_t first, std::uint32_t last);

  std::vector<Segment> segments_;
  std::vector<Node> nodes_;
};

}  // namespace loft
