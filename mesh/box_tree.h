// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "cdt/effort.h"
#include "mesh/box3.h"

namespace loft {

/// A bounding volume hierarchy: finds the boxes that meet a box, or each other.
/// Split at the median centre along the longest axis, so at most log2(n) deep whatever the input.
/// Cost: O(n log n) to build, 64 bytes a box.
class BoxTree {
 public:
  explicit BoxTree(std::span<const Box3> boxes);

  /// Calls visit(i) for every box i that meets `query`.
  template <class Visit>
  void for_each_meeting(const Box3& query, Visit visit) const {
    if (!nodes_.empty()) search(0, query, visit);
  }

  /// Calls visit(i, j) once for every two boxes that meet.
  template <class Visit>
  void for_each_pair(Visit visit) const {
    all_of_pairs([&](std::uint32_t i, std::uint32_t j) {
      visit(i, j);
      return true;
    });
  }

  /// Whether a test holds for every two boxes that meet; stops at the first that fail.
  template <class Test>
  bool all_of_pairs(Test test) const {
    return nodes_.empty() || pair_within(0, test);
  }

 private:
  static constexpr std::uint32_t leaf_size = 4;

  /// An inner node's first child follows it in nodes_.
  struct Node {
    Box3 box;
    std::uint32_t first = 0;  ///< its boxes are items_[first, last)
    std::uint32_t last = 0;
    std::uint32_t second = 0;  ///< the second child; 0 in a leaf
  };
  struct Item {
    Box3 box;
    std::uint32_t index = 0;
  };

  void build(std::uint32_t first, std::uint32_t last);

  template <class Visit>
  void search(std::uint32_t node, const Box3& query, Visit& visit) const;
  template <class Test>
  bool pair_within(std::uint32_t node, Test& test) const;
  template <class Test>
  bool pair_between(std::uint32_t a, std::uint32_t b, Test& test) const;
  template <class Test>
  bool pair_leaves(const Node& a, const Node& b, Test& test) const;

  std::vector<Item> items_;
  std::vector<Node> nodes_;  ///< root first, parents before children
};

template <class Visit>
void BoxTree::search(std::uint32_t node, const Box3& query, Visit& visit) const {
  const Node& n = nodes_[node];
  cdt::spend();
  if (!boxes_meet(n.box, query)) return;
  if (n.second != 0) {
    search(node + 1, query, visit);
    search(n.second, query, visit);
    return;
  }
  for (std::uint32_t i = n.first; i < n.last; ++i) {
    if (boxes_meet(items_[i].box, query)) visit(items_[i].index);
  }
}

template <class Test>
bool BoxTree::pair_within(std::uint32_t node, Test& test) const {
  const Node& n = nodes_[node];
  if (n.second != 0)
    return pair_within(node + 1, test) && pair_within(n.second, test) &&
           pair_between(node + 1, n.second, test);
  for (std::uint32_t i = n.first; i < n.last; ++i) {
    for (std::uint32_t j = i + 1; j < n.last; ++j) {
      if (boxes_meet(items_[i].box, items_[j].box) && !test(items_[i].index, items_[j].index))
        return false;
    }
  }
  return true;
}

/// Descends into the node of more boxes first.
template <class Test>
bool BoxTree::pair_between(std::uint32_t a, std::uint32_t b, Test& test) const {
  const Node& node_a = nodes_[a];
  const Node& node_b = nodes_[b];
  cdt::spend();
  if (!boxes_meet(node_a.box, node_b.box)) return true;
  if (node_a.second == 0 && node_b.second == 0) return pair_leaves(node_a, node_b, test);
  if (node_a.last - node_a.first >= node_b.last - node_b.first)
    return pair_between(a + 1, b, test) && pair_between(node_a.second, b, test);
  return pair_between(a, b + 1, test) && pair_between(a, node_b.second, test);
}

template <class Test>
bool BoxTree::pair_leaves(const Node& a, const Node& b, Test& test) const {
  for (std::uint32_t i = a.first; i < a.last; ++i) {
    cdt::spend();
    if (!boxes_meet(items_[i].box, b.box)) continue;
    for (std::uint32_t j = b.first; j < b.last; ++j) {
      if (boxes_meet(items_[i].box, items_[j].box) && !test(items_[i].index, items_[j].index))
        return false;
    }
  }
  return true;
}

}  // namespace loft
