// SPDX-License-Identifier: MIT
// Sewing: edges that still join the same two vertices get midpoints of their own.
#include <algorithm>
#include <map>
#include <utility>

#include "reconstruct/sew/sewing.h"

namespace loft {

HalfEdge Sewing::latest(HalfEdge h) const {
  for (auto to = moved_.find(h); to != moved_.end(); to = moved_.find(h)) h = to->second;
  return h;
}

void Sewing::split_double_edges(std::vector<Crowd>& crowds) {
  std::ranges::sort(crowds, {},
                    [](const Crowd& crowd) { return std::pair(crowd.low, crowd.high); });
  for (const Crowd& crowd : crowds) split_double_edges(crowd);
}

/// Where edges at one place still join the same two vertices, all that are there get midpoints,
/// so that they go on touching corner by corner.
void Sewing::split_double_edges(const Crowd& crowd) {
  const auto ends = [this](HalfEdge h) { return std::minmax({vertex(h), vertex(next(h))}); };
  std::map<HalfEdge, HalfEdge> uncut;  // before cuts, so that no layer but these two has a say
  for (const HalfEdge h : crowd.half_edges) uncut[latest(h)] = h;
  std::vector<HalfEdge> edges;
  for (const HalfEdge before : crowd.half_edges) {
    const HalfEdge h = latest(before);
    if (mate(h).is_none() || before < uncut.at(mate(h))) edges.push_back(h);
  }
  std::ranges::sort(edges, {}, ends);
  if (std::ranges::adjacent_find(edges, {}, ends) == edges.end()) return;
  for (const HalfEdge h : edges) split_edge(h);
}

/// A midpoint on the edge of h: both its faces are cut in two; on an open rim its only one.
void Sewing::split_edge(HalfEdge h) {
  const HalfEdge g = mate(h);
  const Vec3 p = place(h);
  const Vec3 q = place(next(h));
  const auto middle = static_cast<std::uint32_t>(midpoints_.size()) | VertexNumbers::midpoint_mark;
  // The same from either end: others may be at the same place.
  midpoints_.push_back(
      {{(p[0] + q[0]) / 2, (p[1] + q[1]) / 2, (p[2] + q[2]) / 2},
       {VertexKind::steiner, at(h.layer).layer.slice, Origin::none, Origin::none}});
  const HalfEdge h_half = cut(h, middle);
  if (g.is_none()) return;
  const HalfEdge g_half = cut(g, middle);
  join(h, g_half);
  join(g, h_half);
}

/// Cuts the face of h from the new vertex to the corner opposite. h keeps the first half of its
/// edge; returns the half-edge on the second one.
HalfEdge Sewing::cut(HalfEdge h, std::uint32_t middle) {
  State& state = at(h.layer);
  auto& tiles = state.layer.tiles.tiles;
  const auto f = static_cast<std::uint32_t>(tiles.size());
  const HalfEdge n = next(h);
  const std::uint32_t from = state.node(n.index);
  const std::uint32_t opposite = state.node(prev(h).index);
  tiles.push_back({{middle, from, opposite}, tiles[h.face()].kind});
  state.mates.resize(3 * tiles.size(), Origin::none);
  state.cuts.push_back(static_cast<std::uint32_t>(cut_faces_.size()));
  cut_faces_.push_back({h.layer, f});
  if (const HalfEdge beyond = mate(n); !beyond.is_none()) join({h.layer, 3 * f + 1}, beyond);
  set_node(n, middle);
  moved_[n] = {h.layer, 3 * f + 1};
  join(n, {h.layer, 3 * f + 2});
  return {h.layer, 3 * f};
}

}  // namespace loft
