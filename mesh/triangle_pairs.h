// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "cdt/effort.h"
#include "mesh/box_tree.h"
#include "mesh/oriented_box.h"
#include "mesh/predicates.h"

namespace loft {

/// Finds the pairs of triangles that may meet elsewhere than in common corners.
///
/// A tree of boxes, turned where that helps, so that long thin triangles side by side are told
/// apart. No box tells triangles apart that have a corner in common; where hundreds have, they are
/// one branch of the tree, and told apart by the arcs that they show to that corner. Cost: O(n log
/// n) to build, about 200 bytes a triangle.
class TrianglePairs {
 public:
  using Vertices = std::array<std::uint32_t, 3>;

  /// `vertices`: the numbers of each triangle's corners, below `vertex_count`.
  /// `reach`: triangles no further apart than that count as those that may meet. Precondition if it
  /// is not 0: no triangles have a vertex in common.
  TrianglePairs(std::span<const Corners> triangles, std::span<const Vertices> vertices,
                std::size_t vertex_count, double reach = 0);

  /// Whether a test holds for every two triangles of which triangles_meet() may be true, once each;
  /// stops at the first that fail. Precondition: none is degenerate, else pairs with it may be left
  /// out.
  template <class Test>
  bool all_of(Test test) const {
    return nodes_.empty() || within(0, 0, test);
  }

  template <class Visit>
  void for_each(Visit visit) const {
    all_of([&](std::uint32_t i, std::uint32_t j) {
      visit(i, j);
      return true;
    });
  }

  /// Triangles of some numbers have changed: `triangles` are all of them, as
  /// they are now, `vertices` as they were. They stay in their branches, which grow; arcs are made
  /// anew in the fans of those that changed. Precondition: the reach is 0.
  void update(std::span<const std::uint32_t> changed, std::span<const Corners> triangles,
              std::span<const Vertices> vertices);

  /// As for_each(), for pairs of which one changed in the last update; all before the first.
  template <class Visit>
  void for_each_changed(Visit visit) const {
    const auto test = [&](std::uint32_t i, std::uint32_t j) {
      visit(i, j);
      return true;
    };
    if (!nodes_.empty()) within(0, round_, test);
  }

 private:
  static constexpr std::uint32_t leaf_size = 4;
  static constexpr std::uint32_t none = 0xffff'ffff;

  /// An inner node's first child follows it in nodes_.
  struct Node {
    Box3 box = no_box;
    std::uint32_t first = 0;  ///< its triangles are items_[first, last)
    std::uint32_t last = 0;
    std::uint32_t second = 0;     ///< the second child; 0 in a leaf
    std::uint32_t turned = none;  ///< the place of its turned box, if it has one
    std::uint32_t fan = none;     ///< the place of the arcs of all its triangles, if it is one
    std::uint32_t round = 0;      ///< the update that changed any of them last
  };
  struct Item {
    Box3 box;
    std::uint32_t index = 0;
    std::uint32_t round = 0;
  };
  struct Fan {
    BoxTree arcs;
    std::uint32_t first;  ///< arc i is that of items_[first + i]
    std::uint32_t hub;
  };
  class Builder;

  /// The arcs that the triangles of a fan show to its hub.
  [[nodiscard]] static BoxTree arcs_of(std::span<const Item> items, std::uint32_t hub,
                                       std::span<const Corners> triangles,
                                       std::span<const Vertices> vertices);
  /// Of the places of the changed ones among the items those of a node.
  void refresh(std::uint32_t node, std::span<const std::uint32_t> places,
               std::span<const Corners> triangles, std::span<const Vertices> vertices);
  void refresh_turned(const Node& node, std::span<const std::uint32_t> places,
                      std::span<const Corners> triangles);

  /// Whether turned boxes show two nodes apart.
  [[nodiscard]] bool are_apart(const Node& a, const Node& b) const;

  /// Pairs of which none changed since a round are left out.
  template <class Test>
  bool within(std::uint32_t node, std::uint32_t since, Test& test) const;
  template <class Test>
  bool between(std::uint32_t a, std::uint32_t b, std::uint32_t since, Test& test) const;
  template <class Test>
  bool leaves(const Node& a, const Node& b, std::uint32_t since, Test& test) const;
  template <class Test>
  bool pair(const Item& a, const Item& b, std::uint32_t since, Test& test) const {
    return std::max(a.round, b.round) < since || !boxes_meet(a.box, b.box) ||
           test(a.index, b.index);
  }

  std::vector<Item> items_;
  std::vector<Node> nodes_;  ///< root first, parents before children
  std::vector<TurnedBox> turned_;
  std::vector<Fan> fans_;
  std::uint32_t round_ = 0;            ///< how many updates there were
  std::vector<std::uint32_t> places_;  ///< of each triangle among the items, once they are asked
};

template <class Test>
bool TrianglePairs::within(std::uint32_t node, std::uint32_t since, Test& test) const {
  const Node& n = nodes_[node];
  if (n.round < since) return true;
  if (n.fan != none) {
    const Fan& fan = fans_[n.fan];
    return fan.arcs.all_of_pairs([&](std::uint32_t i, std::uint32_t j) {
      const Item& a = items_[fan.first + i];
      const Item& b = items_[fan.first + j];
      return std::max(a.round, b.round) < since || test(a.index, b.index);
    });
  }
  if (n.second != 0)
    return within(node + 1, since, test) && within(n.second, since, test) &&
           between(node + 1, n.second, since, test);
  for (std::uint32_t i = n.first; i < n.last; ++i)
    for (std::uint32_t j = i + 1; j < n.last; ++j)
      if (!pair(items_[i], items_[j], since, test)) return false;
  return true;
}

/// Descends into the node of more triangles first.
template <class Test>
bool TrianglePairs::between(std::uint32_t a, std::uint32_t b, std::uint32_t since,
                            Test& test) const {
  const Node& node_a = nodes_[a];
  const Node& node_b = nodes_[b];
  if (std::max(node_a.round, node_b.round) < since) return true;
  cdt::spend();
  if (!boxes_meet(node_a.box, node_b.box) || are_apart(node_a, node_b)) return true;
  if (node_a.second == 0 && node_b.second == 0) return leaves(node_a, node_b, since, test);
  if (node_b.second == 0 ||
      (node_a.second != 0 && node_a.last - node_a.first >= node_b.last - node_b.first))
    return between(a + 1, b, since, test) && between(node_a.second, b, since, test);
  return between(a, b + 1, since, test) && between(a, node_b.second, since, test);
}

template <class Test>
bool TrianglePairs::leaves(const Node& a, const Node& b, std::uint32_t since, Test& test) const {
  for (std::uint32_t i = a.first; i < a.last; ++i) {
    cdt::spend();
    if (!boxes_meet(items_[i].box, b.box)) continue;
    for (std::uint32_t j = b.first; j < b.last; ++j)
      if (!pair(items_[i], items_[j], since, test)) return false;
  }
  return true;
}

}  // namespace loft
