// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "cdt/effort.h"
#include "mesh/oriented_box.h"
#include "mesh/predicates.h"

namespace loft {

/// Triangles in a tree of boxes, turned where that helps, which come, change and go: finds those
/// near some points, however long and thin they are. Triangles that change stay in their branch,
/// which grows: make a new tree when most have gone, changed or are far from where they were.
/// Cost: O(n log n) to build, O(log n) in practice for each change; about 200 bytes a triangle.
class TriangleTree {
 public:
  TriangleTree() = default;
  explicit TriangleTree(std::span<const Corners> triangles);

  /// Adds a triangle near one that is, or was, there. Its number is the count of all there were.
  void add(const Corners& triangle, std::uint32_t near);
  void update(std::uint32_t number, const Corners& triangle);
  void remove(std::uint32_t number);

  /// Whether a test of number and corners holds for all triangles that may meet the convex hull of
  /// some points; stops at the first that fails.
  template <class Test>
  [[nodiscard]] bool all_of_meeting(std::span<const Vec3> points, Test test) const {
    return nodes_.empty() || search(0, OrientedBox(points), test);
  }

 private:
  static constexpr std::size_t first_size = 9;  // of a leaf, at most, when it is made
  static constexpr std::size_t most_size = 16;
  static constexpr std::uint32_t none = 0xffff'ffff;

  /// One line of the cache: what is read of most nodes is the box.
  struct alignas(64) Node {
    Box3 box = no_box;
    std::uint32_t parent = 0;     ///< of the root itself
    std::uint32_t first = 0;      ///< child, the second is next; 0 in a leaf
    std::uint32_t turned = none;  ///< place of its turned box, if it has one
    std::uint32_t leaf = none;    ///< place of what it holds
  };
  /// Triangles that are looked at together are together.
  struct Leaf {
    std::uint32_t size = 0;
    std::array<std::uint32_t, most_size> numbers;
    std::array<Corners, most_size> triangles;
  };
  class Builder;

  [[nodiscard]] bool may_meet(const Node& node, const OrientedBox& query) const;
  [[nodiscard]] static bool may_meet(const Corners& triangle, const OrientedBox& query) {
    const Box3 box = box_around(triangle[0], triangle[1], triangle[2]);
    return boxes_meet(box, query.box) &&
           !(query.is_turned && query.turned.is_apart(query.box, triangle, box));
  }
  /// Puts a triangle into a leaf, or below what was one.
  void insert(std::uint32_t number, const Corners& triangle, std::uint32_t node);
  /// The same where the leaf is full.
  void divide_with(std::uint32_t number, const Corners& triangle, std::uint32_t node);

  template <class Test>
  bool search(std::uint32_t node, const OrientedBox& query, Test& test) const {
    const Node& n = nodes_[node];
    cdt::spend();
    if (!boxes_meet(n.box, query.box) || !may_meet(n, query)) return true;
    if (n.first != 0) return search(n.first, query, test) && search(n.first + 1, query, test);
    const Leaf& leaf = leaves_[n.leaf];
    for (std::uint32_t i = 0; i < leaf.size; ++i)
      if (may_meet(leaf.triangles[i], query) && !test(leaf.numbers[i], leaf.triangles[i]))
        return false;
    return true;
  }

  std::vector<std::uint32_t> node_of_;  // each triangle
  std::vector<Node> nodes_;             // the root is the first
  std::vector<Leaf> leaves_;
  std::vector<TurnedBox> turned_;
};

}  // namespace loft
