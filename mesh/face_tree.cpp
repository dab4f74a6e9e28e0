// SPDX-License-Identifier: MIT
#include "mesh/face_tree.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <numeric>

namespace loft {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
/// Meets nothing and adds nothing.
constexpr Box3 empty_box{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};

}  // namespace

FaceTree::FaceTree(std::span<const Box3> boxes)
    : leaves_(std::bit_ceil(std::max<std::size_t>(boxes.size(), 1))),
      nodes_(2 * leaves_, empty_box),
      items_(leaves_),
      leaf_of_(boxes.size()) {
  std::vector<std::uint32_t> items(boxes.size());
  std::iota(items.begin(), items.end(), 0U);
  build(items, boxes, leaves_, 0);
  for (std::size_t node = leaves_ - 1; node > 0; --node)
    nodes_[node] = joined(nodes_[2 * node], nodes_[2 * node + 1]);
}

/// Lays the items into the leaves from `first` on, which have `room`: each half of the room gets
/// the items of one half of the space.
void FaceTree::build(std::span<std::uint32_t> items, std::span<const Box3> boxes, std::size_t room,
                     std::size_t first) {
  if (items.empty()) return;
  if (room == 1) {
    items_[first] = items.front();
    leaf_of_[items.front()] = first;
    nodes_[leaves_ + first] = boxes[items.front()];
    return;
  }
  const std::size_t half = (items.size() + 1) / 2;
  Box3 all = empty_box;
  for (const std::uint32_t item : items) all = joined(all, boxes[item]);
  const std::size_t axis = longest_axis(all);
  const auto centre = [&](std::uint32_t item) {
    return boxes[item].low[axis] + boxes[item].high[axis];
  };
  std::ranges::nth_element(items, items.begin() + static_cast<std::ptrdiff_t>(half), {}, centre);
  build(items.first(half), boxes, room / 2, first);
  build(items.subspan(half), boxes, room / 2, first + room / 2);
}

void FaceTree::update(std::uint32_t item, const Box3& box) {
  std::size_t node = leaves_ + leaf_of_[item];
  nodes_[node] = box;
  while ((node /= 2) > 0) nodes_[node] = joined(nodes_[2 * node], nodes_[2 * node + 1]);
}

void FaceTree::remove(std::uint32_t item) { update(item, empty_box); }

}  // namespace loft
