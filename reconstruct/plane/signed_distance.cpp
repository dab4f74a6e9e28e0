// SPDX-License-Identifier: MIT
#include "reconstruct/signed_distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace loft {

namespace {

using cdt::Point;

constexpr std::uint32_t leaf_size = 8;

/// More levels than any tree has whose nodes are halved.
constexpr std::size_t most_levels = 64;

double squared_distance(Point p, const cdt::Box& box) {
  const double dx = std::max({box.low.x - p.x, p.x - box.high.x, 0.0});
  const double dy = std::max({box.low.y - p.y, p.y - box.high.y, 0.0});
  return dx * dx + dy * dy;
}

/// The foot of p on the segment ab; exactly a or b where it is an end.
Point foot(Point p, Point a, Point b) {
  const Point along{b.x - a.x, b.y - a.y};
  const double t = (p.x - a.x) * along.x + (p.y - a.y) * along.y;
  const double length = along.x * along.x + along.y * along.y;
  if (!(t > 0)) return a;
  if (t >= length) return b;
  return {a.x + t / length * along.x, a.y + t / length * along.y};
}

}  // namespace

SignedDistance::SignedDistance(const Region& region) {
  for (std::size_t i = 0; i < region.loop_count(); ++i) {
    const auto loop = region.loop(i);
    for (std::size_t k = 0; k < loop.size(); ++k)
      edges_.push_back({region.points[loop[k]], region.points[loop[(k + 1) % loop.size()]]});
  }
  if (!edges_.empty()) build(0, static_cast<std::uint32_t>(edges_.size()));
}

void SignedDistance::build(std::uint32_t first, std::uint32_t last) {
  Node node{{}, first, last - first};
  for (std::uint32_t i = first; i < last; ++i) {
    node.box.add(edges_[i].from);
    node.box.add(edges_[i].to);
  }
  const std::size_t self = nodes_.size();
  nodes_.push_back(node);
  if (last - first <= leaf_size) return;

  const bool by_x = node.box.high.x - node.box.low.x > node.box.high.y - node.box.low.y;
  const auto key = [by_x](const Edge& e) { return by_x ? e.from.x + e.to.x : e.from.y + e.to.y; };
  const std::uint32_t middle = first + (last - first) / 2;
  const auto at = [&](std::uint32_t i) { return edges_.begin() + i; };
  std::nth_element(at(first), at(middle), at(last),
                   [&](const Edge& a, const Edge& b) { return key(a) < key(b); });
  build(first, middle);
  nodes_[self].first = static_cast<std::uint32_t>(nodes_.size());
  nodes_[self].count = 0;
  build(middle, last);
}

/// Where a corner is nearest, the edge that is the next one around it decides on which side of the
/// boundary p is: the one that deviates least from the direction to p.
SignedDistance::Value SignedDistance::at(Point p) const {
  double best = std::numeric_limits<double>::infinity();
  double straightness = -1;  // of the direction to p across the best edge, squared
  Edge nearest{};
  std::array<std::uint32_t, most_levels> stack;
  std::size_t depth = 0;
  stack[depth++] = 0;
  while (depth != 0) {
    const std::uint32_t self = stack[--depth];
    const Node& node = nodes_[self];
    if (squared_distance(p, node.box) > best) continue;
    if (node.count == 0) {
      std::uint32_t near = self + 1;
      std::uint32_t far = node.first;
      if (squared_distance(p, nodes_[far].box) < squared_distance(p, nodes_[near].box))
        std::swap(near, far);
      stack[depth++] = far;
      stack[depth++] = near;
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      const Edge& e = edges_[i];
      const Point q = foot(p, e.from, e.to);
      const double squared = (p.x - q.x) * (p.x - q.x) + (p.y - q.y) * (p.y - q.y);
      if (squared > best) continue;
      const Point along{e.to.x - e.from.x, e.to.y - e.from.y};
      const double across = along.x * (p.y - q.y) - along.y * (p.x - q.x);
      const double straight = across * across / (along.x * along.x + along.y * along.y);
      if (squared == best && straight <= straightness) continue;
      best = squared;
      straightness = straight;
      nearest = e;
    }
  }
  const Point q = foot(p, nearest.from, nearest.to);
  const Point along{nearest.to.x - nearest.from.x, nearest.to.y - nearest.from.y};
  const double across = along.x * (p.y - q.y) - along.y * (p.x - q.x);
  const double distance = std::sqrt(best);
  if (!(distance > 0)) {
    const double length = std::hypot(along.x, along.y);
    return {0, {along.y / length, -along.x / length}};
  }
  const double sign = across > 0 ? -1 : 1;
  return {sign * distance, {sign * (p.x - q.x) / distance, sign * (p.y - q.y) / distance}};
}

}  // namespace loft
