// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "cdt/point.h"

namespace loft::overlay {

/// A directed piece of a ring.
struct RingEdge {
  cdt::Point from;
  cdt::Point to;
  std::uint32_t ring = 0;

  [[nodiscard]] cdt::Box box() const {
    cdt::Box result;
    result.add(from);
    result.add(to);
    return result;
  }
};

[[nodiscard]] inline bool meet(const cdt::Box& a, const cdt::Box& b) {
  return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y;
}

/// Edges in a tree of boxes: halved again and again in the direction in which their middles are
/// spread further. A view.
class EdgeTree {
 public:
  /// Cost: O(n log n).
  explicit EdgeTree(std::span<const RingEdge> edges) : edges_(edges), order_(edges.size()) {
    std::iota(order_.begin(), order_.end(), 0U);
    build(0, order_);
  }

  /// Calls visit(number) for the edges in those boxes of which `may`, asked from the largest box
  /// down, says that they may have what is looked for.
  template <class May, class Visit>
  void search(const May& may, const Visit& visit) const {
    search(0, order_, may, visit);
  }

 private:
  using Numbers = std::span<std::uint32_t>;
  static constexpr std::size_t most_in_leaf = 4;

  /// Twice the middle of an edge.
  [[nodiscard]] cdt::Point middle(std::uint32_t e) const {
    return {edges_[e].from.x + edges_[e].to.x, edges_[e].from.y + edges_[e].to.y};
  }

  void build(std::size_t node, Numbers numbers) {
    if (boxes_.size() <= node) boxes_.resize(node + 1);
    cdt::Box middles;
    for (const std::uint32_t e : numbers) {
      boxes_[node].add(edges_[e].from);
      boxes_[node].add(edges_[e].to);
      middles.add(middle(e));
    }
    if (numbers.size() <= most_in_leaf) return;
    const std::size_t half = numbers.size() / 2;
    put_smaller_first(numbers, half, middles);
    build(2 * node + 1, numbers.first(half));
    build(2 * node + 2, numbers.subspan(half));
  }

  void put_smaller_first(Numbers numbers, std::size_t half, const cdt::Box& middles) const {
    const auto at = numbers.begin() + static_cast<std::ptrdiff_t>(half);
    if (middles.high.x - middles.low.x > middles.high.y - middles.low.y)
      std::ranges::nth_element(numbers, at, {}, [&](std::uint32_t e) { return middle(e).x; });
    else
      std::ranges::nth_element(numbers, at, {}, [&](std::uint32_t e) { return middle(e).y; });
  }

  template <class May, class Visit>
  void search(std::size_t node, std::span<const std::uint32_t> numbers, const May& may,
              const Visit& visit) const {
    if (!may(boxes_[node])) return;
    if (numbers.size() <= most_in_leaf) return void(std::ranges::for_each(numbers, visit));
    const std::size_t half = numbers.size() / 2;
    search(2 * node + 1, numbers.first(half), may, visit);
    search(2 * node + 2, numbers.subspan(half), may, visit);
  }

  std::span<const RingEdge> edges_;
  std::vector<std::uint32_t> order_;  // the leaves' edges, leaf after leaf
  std::vector<cdt::Box> boxes_;       // those in box i are in 2i + 1 and 2i + 2
};

}  // namespace loft::overlay
