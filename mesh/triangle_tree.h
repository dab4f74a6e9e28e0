// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "cdt/effort.h"
#include "mesh/oriented_box.h"
#include "mesh/predicates.h"

namespace loft {

/// Triangles in a tree of oriented boxes, which come, change and go: finds those near some points,
/// however long and thin they are. Boxes only grow; make a new tree when most triangles have gone
/// or changed. Cost: O(n log n) to build, O(log n) in practice for each change; about 300 bytes a
/// triangle.
class TriangleTree {
 public:
  TriangleTree() = default;
  explicit TriangleTree(std::vector<Corners> triangles);

  /// Its number is the count of triangles that there were.
  void add(const Corners& triangle);
  void update(std::uint32_t number, const Corners& triangle);
  void remove(std::uint32_t number);
  /// All that there ever were.
  [[nodiscard]] std::size_t size() const { return triangles_.size(); }

  /// Whether a test holds for all triangles that may meet the convex hull of some points; stops at
  /// the first that fails.
  template <class Test>
  [[nodiscard]] bool all_of_meeting(std::span<const Vec3> points, Test test) const {
    return nodes_.empty() || search(0, OrientedBox(points), test);
  }

 private:
  static constexpr std::size_t leaf_size = 8;

  struct Node {
    OrientedBox box;
    std::uint32_t first = 0;  ///< children; 0 in a leaf, as the root is nobody's child
    std::uint32_t second = 0;
    std::vector<std::uint32_t> triangles;  ///< of a leaf
  };

  [[nodiscard]] Box3 box(std::uint32_t number) const {
    const auto& [a, b, c] = triangles_[number];
    return box_around(a, b, c);
  }
  void build(std::uint32_t node, std::vector<std::uint32_t> numbers);
  void insert(std::uint32_t number);

  template <class Test>
  bool search(std::uint32_t node, const OrientedBox& query, Test& test) const {
    const Node& n = nodes_[node];
    cdt::spend();
    if (!may_meet(n.box, query)) return true;
    if (n.first != 0) return search(n.first, query, test) && search(n.second, query, test);
    for (const std::uint32_t number : n.triangles)
      if (boxes_meet(box(number), query.box()) && !test(number)) return false;
    return true;
  }

  std::vector<Corners> triangles_;
  std::vector<std::uint32_t> leaf_of_;  // each triangle
  std::vector<Node> nodes_;             // the root is the first
};

}  // namespace loft
