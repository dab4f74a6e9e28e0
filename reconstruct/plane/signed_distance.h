// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "cdt/point.h"
#include "reconstruct/region.h"

namespace loft {

/// How far places in the plane are from the boundary of a region.
class SignedDistance {
 public:
  struct Value {
    double distance;     ///< negative inside
    cdt::Point outward;  ///< unit vector in which the distance grows; 0 upon the boundary's corners
  };

  SignedDistance() = default;
  /// Keeps a copy of the loops' edges. Cost: O(n log n).
  explicit SignedDistance(const Region& region);

  [[nodiscard]] bool is_empty() const { return edges_.empty(); }
  /// Precondition: the region is not empty. Cost: O(log n) in practice.
  [[nodiscard]] Value at(cdt::Point p) const;

 private:
  struct Edge {  // the region is on its left
    cdt::Point from;
    cdt::Point to;
  };
  struct Node {
    cdt::Box box;
    std::uint32_t first;  // leaf: its edges are first ... first + count - 1
    std::uint32_t count;  // inner: 0; children are the next node and node `first`
  };

  void build(std::uint32_t first, std::uint32_t last);

  std::vector<Edge> edges_;
  std::vector<Node> nodes_;
};

}  // namespace loft
