// SPDX-License-Identifier: MIT
#include "reconstruct/sew/used_points.h"

#include <algorithm>

namespace loft {

UsedPoints::UsedPoints(const Region& region, const Region* lower, const TileSet* below,
                       const TileSet* above) {
  if (region.line_count() == 0) return;
  std::vector<bool> is_used(region.points.size());
  const auto note = [&](const TileSet* tiles, std::size_t first) {
    if (tiles == nullptr) return;
    for (const Tile& tile : tiles->tiles)
      for (const std::uint32_t node : tile.nodes)
        if (node >= first && node - first < is_used.size()) is_used[node - first] = true;
  };
  note(below, lower == nullptr ? 0 : lower->points.size());
  note(above, 0);
  for (const std::uint32_t v : region.loop_vertices) is_used[v] = true;

  region_ = region;
  region_->points.clear();
  region_->origins.clear();
  region_->line_vertices.clear();
  region_->line_starts = {0};
  region_->line_origins.clear();
  numbers_.assign(region.points.size(), Origin::none);
  for (std::uint32_t v = 0; v < is_used.size(); ++v) {
    if (!is_used[v]) continue;
    numbers_[v] = static_cast<std::uint32_t>(region_->points.size());
    region_->points.push_back(region.points[v]);
    region_->origins.push_back(region.origins[v]);
  }
  for (std::size_t i = 0; i < region.line_count(); ++i) {
    const auto line = region.line(i);
    if (!std::ranges::all_of(line, [&](std::uint32_t v) { return is_used[v]; })) continue;
    for (const std::uint32_t v : line) region_->line_vertices.push_back(numbers_[v]);
    region_->line_starts.push_back(static_cast<std::uint32_t>(region_->line_vertices.size()));
    region_->line_origins.push_back(region.line_origins[i]);
  }
}

void renumber(TileSet& tiles, const Region& lower, const Region& upper,
              const UsedPoints& used_lower, const UsedPoints& used_upper) {
  if (!used_lower.has_lines() && !used_upper.has_lines()) return;
  const auto lower_count = static_cast<std::uint32_t>(lower.points.size());
  const auto upper_count = static_cast<std::uint32_t>(upper.points.size());
  const auto count = [](const Region& region, const UsedPoints& used) {
    const Region& now = used.has_lines() ? used.region() : region;
    return static_cast<std::uint32_t>(now.points.size());
  };
  const std::uint32_t lower_now = count(lower, used_lower);
  const std::uint32_t upper_now = count(upper, used_upper);
  const auto change = [&](std::uint32_t& node) {
    if (node < lower_count) {
      node = used_lower.number(node);
    } else if (node < lower_count + upper_count) {
      node = lower_now + used_upper.number(node - lower_count);
    } else {
      node = node - lower_count - upper_count + lower_now + upper_now;
    }
  };
  for (Tile& tile : tiles.tiles) std::ranges::for_each(tile.nodes, change);
  for (Reach& reach : tiles.reaches) change(reach.node);
}

}  // namespace loft
