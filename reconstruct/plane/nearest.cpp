// SPDX-License-Identifier: MIT
#include "reconstruct/nearest.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace loft {

namespace {

constexpr std::uint32_t leaf_size = 8;

double squared_distance(cdt::Point p, cdt::Point a, cdt::Point b) {
  const double x = b.x - a.x;
  const double y = b.y - a.y;
  const double length = x * x + y * y;
  const double along = (p.x - a.x) * x + (p.y - a.y) * y;
  const double t = length > 0 ? std::clamp(along / length, 0.0, 1.0) : 0.0;
  const double dx = p.x - (a.x + t * x);
  const double dy = p.y - (a.y + t * y);
  return dx * dx + dy * dy;
}

double squared_distance(cdt::Point p, const cdt::Box& box) {
  const double dx = std::max({box.low.x - p.x, p.x - box.high.x, 0.0});
  const double dy = std::max({box.low.y - p.y, p.y - box.high.y, 0.0});
  return dx * dx + dy * dy;
}

}  // namespace

double distance(cdt::Point p, cdt::Point a, cdt::Point b) {
  return std::sqrt(squared_distance(p, a, b));
}

NearestSegment::NearestSegment(std::vector<Segment> segments) : segments_(std::move(segments)) {
  if (!segments_.empty()) build(0, static_cast<std::uint32_t>(segments_.size()));
}

void NearestSegment::build(std::uint32_t first, std::uint32_t last) {
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

double NearestSegment::distance(cdt::Point p) const {
  double best = std::numeric_limits<double>::infinity();
  std::vector<std::uint32_t> stack;
  if (!nodes_.empty()) stack.push_back(0);
  while (!stack.empty()) {
    const Node& node = nodes_[stack.back()];
    const std::uint32_t self = stack.back();
    stack.pop_back();
    if (squared_distance(p, node.box) >= best) continue;
    if (node.count == 0) {
      std::uint32_t near = self + 1;
      std::uint32_t far = node.first;
      if (squared_distance(p, nodes_[far].box) < squared_distance(p, nodes_[near].box))
        std::swap(near, far);
      stack.push_back(far);
      stack.push_back(near);
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
      best = std::min(best, squared_distance(p, segments_[i][0], segments_[i][1]));
  }
  return std::sqrt(best);
}

}  // namespace loft
