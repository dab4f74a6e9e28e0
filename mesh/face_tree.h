// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/box_tree.h"

namespace loft {

/// A bounding volume hierarchy over boxes that change and go: finds those that meet a box.
/// Its shape stays as it was built; make a new one when most boxes have gone or grown.
/// Cost: O(n log n) to build, O(log n) for each change; about 150 bytes a box.
class FaceTree {
 public:
  explicit FaceTree(std::span<const Box3> boxes);

  void update(std::uint32_t item, const Box3& box);
  void remove(std::uint32_t item);

  /// Whether a test holds for all items whose box meets `query`; stops at the first that fails.
  template <class Test>
  [[nodiscard]] bool all_of_meeting(const Box3& query, Test test) const {
    return search(1, query, test);
  }

 private:
  void build(std::span<std::uint32_t> items, std::span<const Box3> boxes, std::size_t room,
             std::size_t first);

  template <class Test>
  bool search(std::size_t node, const Box3& query, Test& test) const {
    if (!boxes_meet(nodes_[node], query)) return true;
    if (node >= leaves_) return test(items_[node - leaves_]);
    return search(2 * node, query, test) && search(2 * node + 1, query, test);
  }

  std::size_t leaves_;                // a power of two
  std::vector<Box3> nodes_;           // node i has the children 2i and 2i + 1; the root is 1
  std::vector<std::uint32_t> items_;  // of each leaf
  std::vector<std::size_t> leaf_of_;  // of each item
};

}  // namespace loft
