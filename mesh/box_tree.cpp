// SPDX-License-Identifier: MIT
#include "mesh/box_tree.h"

#include <algorithm>

namespace loft {

std::size_t longest_axis(const Box3& box) {
  std::size_t longest = 0;
  for (std::size_t axis = 1; axis < 3; ++axis) {
    if (box.high[axis] - box.low[axis] > box.high[longest] - box.low[longest]) longest = axis;
  }
  return longest;
}

BoxTree::BoxTree(std::span<const Box3> boxes) {
  if (boxes.empty()) return;
  items_.reserve(boxes.size());
  for (std::uint32_t i = 0; i < boxes.size(); ++i) items_.push_back({boxes[i], i});
  nodes_.reserve(boxes.size());
  build(0, static_cast<std::uint32_t>(items_.size()));
}

void BoxTree::build(std::uint32_t first, std::uint32_t last) {
  const auto items = std::span(items_).subspan(first, last - first);
  Box3 box = items.front().box;
  for (const Item& item : items) box = joined(box, item.box);
  const std::size_t node = nodes_.size();
  nodes_.push_back({box, first, last, 0});
  if (last - first <= leaf_size) return;

  const std::size_t axis = longest_axis(box);
  const auto before = [axis](const Item& a, const Item& b) {
    const double a_centre = a.box.low[axis] + a.box.high[axis];
    const double b_centre = b.box.low[axis] + b.box.high[axis];
    return a_centre != b_centre ? a_centre < b_centre : a.index < b.index;
  };
  const std::uint32_t half = (last - first) / 2;
  std::ranges::nth_element(items, items.begin() + half, before);
  build(first, first + half);
  nodes_[node].second = static_cast<std::uint32_t>(nodes_.size());
  build(first + half, last);
}

}  // namespace loft
