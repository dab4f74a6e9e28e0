// SPDX-License-Identifier: MIT
#include "reconstruct/fair/outline_net.h"

#include <algorithm>

namespace loft {

Neighbours::Neighbours(const OutlineNet& net) : starts_(net.points.size() + 1) {
  for (std::size_t i = 0; i < net.loop_count(); ++i) {
    const auto loop = net.loop(i);
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const std::uint32_t next = loop[k + 1 == loop.size() ? 0 : k + 1];
      if (loop[k] != next) edges_.emplace_back(std::min(loop[k], next), std::max(loop[k], next));
    }
  }
  std::ranges::sort(edges_);
  edges_.erase(std::unique(edges_.begin(), edges_.end()), edges_.end());
  for (const auto& [a, b] : edges_) {
    ++starts_[a + 1];
    ++starts_[b + 1];
  }
  for (std::size_t i = 1; i < starts_.size(); ++i) starts_[i] += starts_[i - 1];
  std::vector<std::uint32_t> end(starts_.begin(), starts_.end() - 1);
  all_.resize(2 * edges_.size());
  // Smaller neighbours first, then larger ones: each row ascends.
  for (const auto& [a, b] : edges_) all_[end[b]++] = a;
  for (const auto& [a, b] : edges_) all_[end[a]++] = b;
}

double signed_area(std::span<const std::uint32_t> loop, std::span<const cdt::Point> places) {
  if (loop.empty()) return 0;
  const cdt::Point from = places[loop.front()];  // near, so that little is rounded
  double twice = 0;
  for (std::size_t k = 1; k + 1 < loop.size(); ++k) {
    const cdt::Point a = places[loop[k]];
    const cdt::Point b = places[loop[k + 1]];
    twice += (a.x - from.x) * (b.y - from.y) - (b.x - from.x) * (a.y - from.y);
  }
  return twice / 2;
}

}  // namespace loft
