// SPDX-License-Identifier: MIT
// Sewing: the vertices whose faces form more than one fan, and their doubles.
#include <algorithm>
#include <utility>

#include "reconstruct/sew/sewing.h"

namespace loft {

// namespace

/// Faces around one corner that mates connect: one fan.
template <class Visit>
void Sewing::for_each_in_fan(HalfEdge corner, Visit visit) const {
  HalfEdge h = corner;
  do {
    visit(h);
    h = mate(h);
    if (h.is_none()) break;
    h = next(h);
  } while (h != corner);
  if (!h.is_none()) return;
  for (h = mate(prev(corner)); !h.is_none(); h = mate(prev(h))) visit(h);
}

/// Whether the corners at an inner node of a layer are one fan.
bool Sewing::is_one_fan(std::uint32_t layer, std::uint32_t node) const {
  const State& state = at(layer);
  if (state.corner_counts[node] == 0) return true;
  std::uint32_t count = 0;
  for_each_in_fan({layer, state.first_corners[node]}, [&](HalfEdge) { ++count; });
  return count == state.corner_counts[node];
}

/// The same for a point of the slice below a layer.
bool Sewing::is_one_fan_at(std::uint32_t layer, std::uint32_t point) const {
  std::uint32_t corners = 0;
  HalfEdge first;
  const auto look = [&](std::uint32_t of, std::uint32_t node) {
    const State& state = at(of);
    if (state.corner_counts[node] == 0) return;
    corners += state.corner_counts[node];
    first = {of, state.first_corners[node]};
  };
  if (has(layer)) look(layer, point);
  if (layer > 0) look(layer - 1, at(layer - 1).lower_count + point);
  if (corners == 0) return true;
  std::uint32_t count = 0;
  for_each_in_fan(first, [&](HalfEdge) { ++count; });
  return count == corners;
}

/// Finds the vertices with more than one fan, in the slice below a layer and inside the layer.
void Sewing::find_fans(std::uint32_t layer, Found& found) const {
  std::vector<std::uint32_t> slots_below;  // of the nodes of the layer below, in `corners`
  std::vector<std::uint32_t> slots;        // of the layer's own nodes
  std::uint32_t slot_count = 0;
  const auto note = [&](std::vector<std::uint32_t>& slots_there, std::uint32_t of,
                        std::uint32_t node) {
    slots_there.resize(at(of).corner_counts.size(), Origin::none);
    slots_there[node] = slot_count;
  };
  const Region& slice = has(layer) ? *at(layer).layer.lower : *at(layer - 1).layer.upper;
  for (std::uint32_t p = 0; p < slice.points.size(); ++p) {
    if (is_one_fan_at(layer, p)) continue;
    if (has(layer)) note(slots, layer, p);
    if (layer > 0) note(slots_below, layer - 1, at(layer - 1).lower_count + p);
    ++slot_count;
  }
  for (std::uint32_t n = has(layer) ? at(layer).contour_count : Origin::none;
       has(layer) && n < at(layer).corner_counts.size(); ++n) {
    if (is_one_fan(layer, n)) continue;
    note(slots, layer, n);
    ++slot_count;
  }

  std::vector<std::vector<HalfEdge>> corners(slot_count);
  const auto gather = [&](std::uint32_t from, const std::vector<std::uint32_t>& slots_there) {
    if (slots_there.empty()) return;
    const State& state = at(from);
    for (std::uint32_t h = 0; h < state.mates.size(); ++h) {
      const std::uint32_t node = state.node(h);
      if (node < slots_there.size() && slots_there[node] != Origin::none)
        corners[slots_there[node]].push_back({from, h});
    }
  };
  gather(layer - 1, slots_below);
  gather(layer, slots);
  for (const auto& some : corners) add_fans(some, found);
}

/// Fans of a vertex, from all its corners in their order; the first one keeps the vertex.
void Sewing::add_fans(std::span<const HalfEdge> corners, Found& found) const {
  std::vector<bool> is_done(corners.size());
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (is_done[i]) continue;
    Fan fan;
    for_each_in_fan(corners[i], [&](HalfEdge h) {
      is_done[static_cast<std::size_t>(std::ranges::lower_bound(corners, h) - corners.begin())] =
          true;
      fan.push_back(h);
    });
    if (i > 0) found.fans.push_back(std::move(fan));
  }
}

/// Doubles the vertices whose further fans begin in a layer; then cuts the double edges in it and
/// in the slice below. So the layer below is final.
void Sewing::separate(std::uint32_t layer) {
  State& state = at(layer);
  std::ranges::sort(state.fans, {}, [](const Fan& fan) { return fan.front(); });
  for (const Fan& fan : state.fans) {
    const auto number = static_cast<std::uint32_t>(doubled_.size()) | VertexNumbers::doubled_mark;
    doubled_.push_back({place(fan.front()), origin(fan.front())});
    doubled_points_.push_back(slice_point(fan.front()));
    for (const HalfEdge corner : fan) set_node(corner, number);
  }
  split_double_edges(state.crowds);
  std::erase_if(moved_, [&](const auto& move) { return move.first.layer < layer; });
  state.fans = {};
  state.crowds = {};
  state.lower_rim = {};
  state.upper_rim = {};
  state.corner_counts = {};
  state.first_corners = {};
  added_.push_back({static_cast<std::uint32_t>(doubled_.size()),
                    static_cast<std::uint32_t>(midpoints_.size()),
                    static_cast<std::uint32_t>(cut_faces_.size())});
}

}  // namespace loft
