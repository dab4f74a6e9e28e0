// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "cdt/point.h"

namespace loft {

/// A segment in the plane, from its first end to its second.
using Segment = std::array<cdt::Point, 2>;

/// A box in the plane that is turned as what it holds runs. An arc fits into one as narrow as it
/// bulges; seen from beside it, boxes along the axes of many short arcs are about as near as the
/// nearest one.
class TurnedBox2 {
 public:
  /// Around nothing, along the line that the ends of some segments are nearest to in the mean.
  explicit TurnedBox2(std::span<const Segment> segments);

  void add(cdt::Point p) { box_.add(seen(p)); }
  [[nodiscard]] double area() const {
    return (box_.high.x - box_.low.x) * (box_.high.y - box_.low.y);
  }
  /// No more than the square of the distance to p; `slack`: what rounding may do to a distance.
  [[nodiscard]] double squared_distance(cdt::Point p, double slack) const {
    const cdt::Point q = seen(p);
    const double x = std::max({box_.low.x - q.x - slack, q.x - box_.high.x - slack, 0.0});
    const double y = std::max({box_.low.y - q.y - slack, q.y - box_.high.y - slack, 0.0});
    return x * x + y * y;
  }

 private:
  [[nodiscard]] cdt::Point seen(cdt::Point p) const {
    return {way_.x * p.x + way_.y * p.y, way_.x * p.y - way_.y * p.x};
  }

  cdt::Point way_;  // a unit vector
  cdt::Box box_;    // x along the way, y to its left
};

/// A fixed set of segments in the plane, in a tree of boxes, turned where that helps, to find those
/// near a place.
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
    if (!turned_.empty()) limit = std::min(limit, squared_reach(p, slack_at(p)));
    visit_some_near(p, limit, visit);
  }

  /// The same where not every segment counts: nothing but `visit` tells what is too far away.
  template <class Visit>
  void visit_some_near(cdt::Point p, double limit, Visit visit) const {
    if (nodes_.empty()) return;
    if (turned_.empty())
      search(p, limit, visit);
    else
      search_turned(p, limit, visit);
  }

 private:
  /// More levels than any tree has whose nodes are halved.
  static constexpr std::size_t most_levels = 64;
  /// Of a place as a turned box sees it, and of a foot on a segment, in magnitudes of coordinates:
  /// about ten roundings. What is left out is further away as it would be computed, too.
  static constexpr double rounding = 0x1p-48;
  static constexpr std::uint32_t none = 0xffff'ffff;
  /// Fewer segments are found faster without turned boxes.
  static constexpr std::size_t least_turned = 2048;

  struct Node {
    cdt::Box box;
    std::uint32_t first;          // leaf: its segments are first ... first + count - 1
    std::uint32_t count;          // inner: 0; children are the next node and node `first`
    std::uint32_t turned = none;  // place of its turned box, if it has one
  };

  /// Has to be looked at where its distance matters.
  struct Waiting {
    std::uint32_t node;
    double bound;  // no more than the square of its distance
  };

  [[nodiscard]] double slack_at(cdt::Point p) const {
    return rounding * (std::max(std::abs(p.x), std::abs(p.y)) + largest_);
  }
  /// 0 where there is no turned box.
  [[nodiscard]] double turned_distance(cdt::Point p, const Node& node, double slack) const {
    return node.turned == none ? 0 : turned_[node.turned].squared_distance(p, slack);
  }
  /// The square of a distance within which there is a segment, most often hardly more than that of
  /// the nearest: that of those in the leaf that is found going to the nearer child each time. A
  /// search that knew nothing of it would go to a wrong child at each level, and down from there.
  [[nodiscard]] double squared_reach(cdt::Point p, double slack) const;

  template <class Visit>
  void search(cdt::Point p, double limit, Visit& visit) const {
    std::array<std::uint32_t, most_levels> stack;
    std::size_t depth = 0;
    stack[depth++] = 0;
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

  /// In the same order, but for what turned boxes and a reach show to be too far away.
  template <class Visit>
  void search_turned(cdt::Point p, double limit, Visit& visit) const {
    const double slack = slack_at(p);
    std::array<Waiting, most_levels> stack;
    std::size_t depth = 0;
    const auto push = [&](std::uint32_t self, double squared) {
      if (squared > limit) return;
      const double bound = std::max(squared, turned_distance(p, nodes_[self], slack));
      if (bound <= limit) stack[depth++] = {self, bound};
    };
    stack[depth++] = {0, 0};
    while (depth != 0) {
      const auto [self, bound] = stack[--depth];
      if (bound > limit) continue;
      const Node& node = nodes_[self];
      if (node.count == 0) {
        Waiting near{self + 1, squared_distance(p, nodes_[self + 1].box)};
        Waiting far{node.first, squared_distance(p, nodes_[node.first].box)};
        if (far.bound < near.bound) std::swap(near, far);
        push(far.node, far.bound);
        push(near.node, near.bound);
        continue;
      }
      for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
        limit = std::min(limit, visit(segments_[i]));
    }
  }

  static double squared_distance(cdt::Point p, const cdt::Box& box) {
    const double dx = std::max({box.low.x - p.x, p.x - box.high.x, 0.0});
    const double dy = std::max({box.low.y - p.y, p.y - box.high.y, 0.0});
    return dx * dx + dy * dy;
  }
  void build(std::uint32_t first, std::uint32_t last);
  /// Gives a node a turned box, if that is narrower by far.
  void turn(Node& node, std::span<const Segment> segments);

  std::vector<Segment> segments_;
  std::vector<Node> nodes_;
  std::vector<TurnedBox2> turned_;
  double largest_ = 0;  // coordinate
};

}  // namespace loft
