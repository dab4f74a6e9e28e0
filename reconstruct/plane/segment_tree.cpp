// SPDX-License-Identifier: MIT
#include "reconstruct/plane/segment_tree.h"

#include <limits>

namespace loft {

TurnedBox2::TurnedBox2(std::span<const Segment> segments) {
  cdt::Point middle;
  const auto count = static_cast<double>(2 * segments.size());
  for (const Segment& segment : segments)
    for (const cdt::Point p : segment) {
      middle.x += p.x / count;
      middle.y += p.y / count;
    }
  double xx_yy = 0;
  double xy = 0;
  for (const Segment& segment : segments)
    for (const cdt::Point p : segment) {
      const double x = p.x - middle.x;
      const double y = p.y - middle.y;
      xx_yy += x * x - y * y;
      xy += x * y;
    }
  const double angle = std::atan2(2 * xy, xx_yy) / 2;
  way_ = {std::cos(angle), std::sin(angle)};
}

SegmentTree::SegmentTree(std::vector<Segment> segments) : segments_(std::move(segments)) {
  if (segments_.empty()) return;
  build(0, static_cast<std::uint32_t>(segments_.size()));
  const cdt::Box& box = nodes_.front().box;
  largest_ = std::max(
      {std::abs(box.low.x), std::abs(box.low.y), std::abs(box.high.x), std::abs(box.high.y)});
}

double SegmentTree::squared_reach(cdt::Point p, double slack) const {
  const auto from_middle = [&](const Node& node) {
    const double x = node.box.low.x + node.box.high.x - 2 * p.x;
    const double y = node.box.low.y + node.box.high.y - 2 * p.y;
    return x * x + y * y;
  };
  std::uint32_t self = 0;
  while (nodes_[self].count == 0) {
    const std::uint32_t second = nodes_[self].first;
    self = from_middle(nodes_[second]) < from_middle(nodes_[self + 1]) ? second : self + 1;
  }
  double least = std::numeric_limits<double>::infinity();
  for (std::uint32_t i = nodes_[self].first; i < nodes_[self].first + nodes_[self].count; ++i)
    for (const cdt::Point q : segments_[i])
      least = std::min(least, (q.x - p.x) * (q.x - p.x) + (q.y - p.y) * (q.y - p.y));
  const double reach = std::sqrt(least) + slack;
  return reach * reach;
}

void SegmentTree::build(std::uint32_t first, std::uint32_t last) {
  constexpr std::uint32_t leaf_size = 8;
  Node node{{}, first, last - first};
  for (std::uint32_t i = first; i < last; ++i)
    for (const cdt::Point p : segments_[i]) node.box.add(p);
  if (segments_.size() >= least_turned)
    turn(node, std::span(segments_).subspan(first, last - first));
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

void SegmentTree::turn(Node& node, std::span<const Segment> segments) {
  constexpr double most_of_area = 0.5;
  const double area = (node.box.high.x - node.box.low.x) * (node.box.high.y - node.box.low.y);
  if (!(area > 0)) return;
  TurnedBox2 turned(segments);
  for (const Segment& segment : segments)
    for (const cdt::Point p : segment) turned.add(p);
  if (!(turned.area() < most_of_area * area)) return;
  node.turned = static_cast<std::uint32_t>(turned_.size());
  turned_.push_back(turned);
}

}  // namespace loft
