// SPDX-License-Identifier: MIT
#include "reconstruct/sew/sewing.h"

#include <algorithm>
#include <cassert>
#include <iterator>
#include <utility>

#include "reconstruct/defect.h"
#include "reconstruct/parallel.h"

namespace loft {

namespace {

// Mates are coded by their number in their layer and the step to that layer.
constexpr std::uint32_t in_layer_below = 0x8000'0000;
constexpr std::uint32_t in_layer_above = 0x4000'0000;
constexpr std::uint32_t number_bits = VertexNumbers::bound - 1;

}  // namespace

// --- Half-edges and their mates ---

HalfEdge Sewing::mate(HalfEdge h) const {
  const std::uint32_t code = at(h.layer).mates[h.index];
  if (code == Origin::none) return {};
  if ((code & in_layer_below) != 0) return {h.layer - 1, code & number_bits};
  if ((code & in_layer_above) != 0) return {h.layer + 1, code & number_bits};
  return {h.layer, code};
}

void Sewing::set_mate(HalfEdge h, HalfEdge mate) {
  if (!has(h.layer)) return;
  const std::uint32_t step = mate.layer == h.layer  ? 0
                             : mate.layer < h.layer ? in_layer_below
                                                    : in_layer_above;
  at(h.layer).mates[h.index] = mate.index | step;
}

void Sewing::join(HalfEdge a, HalfEdge b) {
  set_mate(a, b);
  set_mate(b, a);
}

std::uint32_t Sewing::vertex(HalfEdge corner) const {
  const State& state = at(corner.layer);
  const std::uint32_t node = state.node(corner.index);
  if ((node & VertexNumbers::doubled_mark) != 0) return node;
  if (node < state.lower_count) return state.lower + node;
  if (node < state.contour_count) return state.upper + (node - state.lower_count);
  return state.inner + (node - state.contour_count);
}

Vec3 Sewing::place(HalfEdge corner) const {
  const State& state = at(corner.layer);
  const std::uint32_t node = state.node(corner.index);
  if ((node & VertexNumbers::midpoint_mark) == VertexNumbers::midpoint_mark)
    return midpoints_[node & number_bits].place;
  if ((node & VertexNumbers::doubled_mark) != 0) return doubled_[node & number_bits].place;
  return place_of(*state.layer.lower, *state.layer.upper, state.layer.tiles.inner, node);
}

Origin Sewing::origin(HalfEdge corner) const {
  const State& state = at(corner.layer);
  const std::uint32_t node = state.node(corner.index);
  if ((node & VertexNumbers::midpoint_mark) == VertexNumbers::midpoint_mark)
    return midpoints_[node & number_bits].origin;
  if ((node & VertexNumbers::doubled_mark) != 0) return doubled_[node & number_bits].origin;
  if (node < state.lower_count) return state.layer.lower->origins[node];
  if (node < state.contour_count) return state.layer.upper->origins[node - state.lower_count];
  const InnerVertex& vertex = state.layer.tiles.inner[node - state.contour_count];
  return {vertex.kind, state.layer.slice, Origin::none, Origin::none};
}

Sewing::SlicePoint Sewing::slice_point(HalfEdge corner) const {
  const State& state = at(corner.layer);
  const std::uint32_t node = state.node(corner.index);
  if (node < state.lower_count) return {corner.layer, node};
  if (node < state.contour_count) return {corner.layer + 1, node - state.lower_count};
  return {};
}

std::uint32_t Sewing::contour_node(HalfEdge corner) const {
  const State& state = at(corner.layer);
  const std::uint32_t node = state.node(corner.index);
  const bool is_doubled = (node & VertexNumbers::midpoint_mark) == VertexNumbers::doubled_mark;
  if (!is_doubled) return node < state.contour_count ? node : Origin::none;
  const auto [layer, point] = doubled_points_[node & number_bits];
  if (layer == corner.layer) return point;
  return layer == corner.layer + 1 ? state.lower_count + point : Origin::none;
}

void Sewing::set_node(HalfEdge corner, std::uint32_t node) {
  at(corner.layer).layer.tiles.tiles[corner.face()].nodes[corner.index % 3] = node;
}

// --- Stages ---

void Sewing::add(std::vector<Layer> layers, unsigned threads) {
  const std::uint32_t first = layer_bound();
  for (Layer& layer : layers) {
    layers_.emplace_back().layer = std::move(layer);
    number(layers_.back());
  }
  for_each_index(layers.size(), threads, [&](std::size_t i, unsigned) {
    pair_within(first + static_cast<std::uint32_t>(i));
  });
  settle(layer_bound(), threads);
}

void Sewing::finish(unsigned threads) {
  settle(layer_bound() + 1, threads);
  split_double_edges(top_crowds_);
  final_bound_ = layer_bound();
}

/// Numbers the vertices and faces of a new layer.
void Sewing::number(State& state) {
  const bool is_first = layers_.size() == 1 && first_layer_ == 0;
  const State* const below = layers_.size() > 1 ? &layers_[layers_.size() - 2] : nullptr;
  assert(is_first || below != nullptr);
  state.lower_count = static_cast<std::uint32_t>(state.layer.lower->points.size());
  state.contour_count =
      state.lower_count + static_cast<std::uint32_t>(state.layer.upper->points.size());
  state.lower = is_first ? 0 : below->upper;
  state.inner = state.lower + state.lower_count;
  state.upper = state.inner + static_cast<std::uint32_t>(state.layer.tiles.inner.size());
  state.face_count = static_cast<std::uint32_t>(state.layer.tiles.tiles.size());
  state.first_face = face_count_;
  face_count_ += state.face_count;
  vertex_count_ = state.upper + static_cast<std::uint32_t>(state.layer.upper->points.size());
  if (vertex_count_ > number_bits || state.face_count > number_bits / 3)
    throw Error("more vertices than can be numbered");
}

/// Joins layers below `bound` to those under them. Then it is known of all but the last one which
/// vertices are to be doubled, and where double edges are left.
void Sewing::settle(std::uint32_t bound, unsigned threads) {
  const std::uint32_t first = joined_bound_;
  std::vector<Found> found(bound - first);
  for_each_index(found.size(), threads, [&](std::size_t i, unsigned) {
    const std::uint32_t layer = first + static_cast<std::uint32_t>(i);
    pair_at(layer, found[i]);
    find_fans(layer, found[i]);
  });
  for (std::uint32_t i = 0; i < found.size(); ++i) {
    for (Fan& fan : found[i].fans) at(fan.front().layer).fans.push_back(std::move(fan));
    auto& crowds = has(first + i) ? at(first + i).crowds : top_crowds_;
    std::ranges::move(found[i].crowds, std::back_inserter(crowds));
  }
  joined_bound_ = bound;
  for (; settled_bound_ + 1 < bound; ++settled_bound_) separate(settled_bound_);
  if (settled_bound_ > 0) final_bound_ = settled_bound_ - 1;
}

void Sewing::drop_below(std::uint32_t layer) {
  while (first_layer_ < layer) {
    layers_.pop_front();
    ++first_layer_;
  }
}

}  // namespace loft
