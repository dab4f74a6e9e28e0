// SPDX-License-Identifier: MIT
#include "reconstruct/registration/loop_pairs.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace loft {

namespace {

using cdt::Point;

/// More pairs of loops than that are not compared.
constexpr std::size_t most_loops = 256;

struct LoopShape {
  bool is_hole;
  double size;   // of a square with its area
  Point centre;  // of its line
};

LoopShape shape(const Region& region, std::uint32_t loop) {
  const Point origin = region.points[region.loop(loop)[0]];
  double twice = 0;
  double length = 0;
  Point sum;
  const auto vertices = region.loop(loop);
  Point p = region.points[vertices.back()];
  for (const std::uint32_t v : vertices) {
    const Point q = region.points[v];
    const double edge = std::hypot(q.x - p.x, q.y - p.y);
    length += edge;
    sum = {sum.x + edge * ((p.x + q.x) / 2 - origin.x),
           sum.y + edge * ((p.y + q.y) / 2 - origin.y)};
    twice += (p.x - origin.x) * (q.y - origin.y) - (p.y - origin.y) * (q.x - origin.x);
    p = q;
  }
  return {twice < 0,
          std::sqrt(std::abs(twice) / 2),
          {origin.x + sum.x / length, origin.y + sum.y / length}};
}

std::vector<LoopShape> shapes(const Region& region) {
  std::vector<LoopShape> made;
  for (std::uint32_t i = 0; i < region.loop_count(); ++i) made.push_back(shape(region, i));
  return made;
}

struct Choice {
  double cost;
  LoopPair pair;
};

std::vector<Choice> choices(const Region& lower, const Region& upper, Point offset) {
  const std::vector<LoopShape> below = shapes(lower);
  const std::vector<LoopShape> above = shapes(upper);
  std::vector<Choice> made;
  for (std::uint32_t i = 0; i < below.size(); ++i) {
    for (std::uint32_t j = 0; j < above.size(); ++j) {
      if (below[i].is_hole != above[j].is_hole) continue;
      const double x = above[j].centre.x - offset.x - below[i].centre.x;
      const double y = above[j].centre.y - offset.y - below[i].centre.y;
      const double size = above[j].size - below[i].size;
      made.push_back({x * x + y * y + size * size, {i, j}});
    }
  }
  std::ranges::sort(made, {}, [](const Choice& choice) {
    return std::tuple(choice.cost, choice.pair.lower, choice.pair.upper);
  });
  return made;
}

}  // namespace

std::optional<std::vector<LoopPair>> pair_loops(const Region& lower, const Region& upper,
                                                Point offset) {
  const std::size_t count = lower.loop_count();
  if (upper.loop_count() != count || count > most_loops) return {};
  std::vector<bool> has_lower(count);
  std::vector<bool> has_upper(count);
  std::vector<LoopPair> pairs;
  for (const auto& [cost, pair] : choices(lower, upper, offset)) {
    if (has_lower[pair.lower] || has_upper[pair.upper]) continue;
    has_lower[pair.lower] = has_upper[pair.upper] = true;
    pairs.push_back(pair);
  }
  if (pairs.size() != count) return {};
  return pairs;
}

}  // namespace loft
