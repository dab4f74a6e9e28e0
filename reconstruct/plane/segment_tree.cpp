// SPDX-License-Identifier: MIT
#include "reconstruct/plane/segment_tree.h"

namespace loft {

SegmentTree::SegmentTree(std::vector<Segment> segments) : segments_(std::move(segments)) {
  if (!segments_.empty()) build(0, static_cast<std::uint32_t>(segments_.size()));
}

void SegmentTree::build(std::uint32_t first, std::uint32_t last) {
  constexpr std::uint32_t leaf_size = 8;
  Node node{{}, first, last - first};
  for (std::uint32_t i = first; i < last; ++i)
    for (const cdt::Point p : segments_[i]) node.box.add(p);
  const std::size_t self = nodes_.size();
  nodes_.push_back(node);
  if (last - first <= leaf_size) return;

  const bool by_x = node.box.high.x - node.box.low.x > node.box.high.y - node.box.low.y;
  const auto key = [by_x](const Segment& s) { return by_x ? s[0].x + s[1].x : s[0].y + s[1].y; };
  const std::uint32_t middle = first + (last - first) / 2;
  const auto at = [&](std::uint32_t i) { return segments_.begin() + i; };
  std::nth_element(at(first), at(middle), at(last),
                   [&](const Segment& a, const Segment& b) { return key(a) < key(b); });
  build(first, middle);
  nodes_[self].first = static_cast<std::uint32_t>(nodes_.size());
  nodes_[self].count = 0;
  build(middle, last);
}

}  // namespace loft
