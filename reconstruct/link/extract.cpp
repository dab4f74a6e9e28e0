// SPDX-License-Identifier: MIT
#include "reconstruct/link/extract.h"

#include <algorithm>
#include <utility>

namespace loft {

Extract::Extract(const Region& region, std::span<const std::uint32_t> loops, bool is_solid,
                 std::span<const std::uint32_t> lines) {
  extract_.z = region.z;
  extract_.slice = region.slice;
  extract_.loop_starts.push_back(0);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> vertices;  // of the region, and their order
  for (const std::uint32_t i : loops) {
    const auto loop = region.loop(i);
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const std::uint32_t v = is_solid ? loop[k] : loop[loop.size() - 1 - k];
      vertices.emplace_back(v, static_cast<std::uint32_t>(vertices.size()));
    }
    extract_.loop_starts.push_back(static_cast<std::uint32_t>(vertices.size()));
  }
  const std::size_t loop_vertex_count = vertices.size();
  for (const std::uint32_t i : lines) {
    if (extract_.line_starts.empty()) extract_.line_starts.push_back(0);
    for (const std::uint32_t v : region.line(i))
      vertices.emplace_back(v, static_cast<std::uint32_t>(vertices.size()));
    extract_.line_starts.push_back(static_cast<std::uint32_t>(vertices.size() - loop_vertex_count));
    extract_.line_origins.push_back(region.line_origins[i]);
  }
  extract_.loop_vertices.resize(loop_vertex_count);
  extract_.line_vertices.resize(vertices.size() - loop_vertex_count);
  std::ranges::sort(vertices);
  for (const auto& [v, place] : vertices) {
    if (original_.empty() || original_.back() != v) {
      original_.push_back(v);
      extract_.points.push_back(region.points[v]);
      extract_.origins.push_back(region.origins[v]);
    }
    const auto here = static_cast<std::uint32_t>(original_.size() - 1);
    if (place < loop_vertex_count) {
      extract_.loop_vertices[place] = here;
    } else {
      extract_.line_vertices[place - loop_vertex_count] = here;
    }
  }
}

TileSet embedded(TileSet tiles, const Extract& lower, const Extract& upper,
                 std::uint32_t lower_count, std::uint32_t upper_count, bool is_solid) {
  const auto part_lower = static_cast<std::uint32_t>(lower.region().points.size());
  const auto part_upper = static_cast<std::uint32_t>(upper.region().points.size());
  const auto renumber = [&](std::uint32_t& node) {
    if (node < part_lower) {
      node = lower.original(node);
    } else if (node < part_lower + part_upper) {
      node = lower_count + upper.original(node - part_lower);
    } else {
      node = node - part_lower - part_upper + lower_count + upper_count;
    }
  };
  for (Reach& reach : tiles.reaches) renumber(reach.node);
  for (Tile& tile : tiles.tiles) {
    std::ranges::for_each(tile.nodes, renumber);
    if (!is_solid) std::swap(tile.nodes[0], tile.nodes[1]);
  }
  return tiles;
}

}  // namespace loft
