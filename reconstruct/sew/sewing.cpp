// SPDX-License-Identifier: MIT
#include "reconstruct/sew/sewing.h"

#include <algorithm>
#include <cassert>
#include <iterator>
#include <numeric>
#include <utility>

#include "cdt/predicates.h"
#include "mesh/predicates.h"
#include "reconstruct/defect.h"
#include "reconstruct/parallel.h"

namespace loft {

namespace {

constexpr std::uint32_t none = Origin::none;

// Mates are coded by their number in their layer and the step to that layer.
constexpr std::uint32_t in_layer_below = 0x8000'0000;
constexpr std::uint32_t in_layer_above = 0x4000'0000;
constexpr std::uint32_t number_bits = VertexNumbers::bound - 1;

/// For r and s in a plane with the line pq: whether both are on the same side of it.
bool on_same_side(const Vec3& p, const Vec3& q, const Vec3& r, const Vec3& s) {
  for (unsigned axis = 0; axis < 3; ++axis) {
    const auto flat = [axis](const Vec3& v) {
      return cdt::Point{v[(axis + 1) % 3], v[(axis + 2) % 3]};
    };
    const int side = cdt::orient(flat(p), flat(q), flat(r));
    if (side != 0) return side == cdt::orient(flat(p), flat(q), flat(s));
  }
  return true;
}

/// A half-edge by the ends of its edge, the smaller one first.
struct Ended {
  std::uint32_t low;
  std::uint32_t high;
  HalfEdge half_edge;

  friend auto operator<=>(const Ended&, const Ended&) = default;
};

/// Calls visit(half-edges) for each edge of a sorted list.
template <class Visit>
void for_each_edge(std::span<const Ended> sorted, Visit visit) {
  std::vector<HalfEdge> edge;
  for (std::size_t i = 0; i < sorted.size();) {
    edge.clear();
    const std::size_t first = i;
    for (; i < sorted.size() && sorted[i].low == sorted[first].low &&
           sorted[i].high == sorted[first].high;
         ++i)
      edge.push_back(sorted[i].half_edge);
    visit(edge);
  }
}

}  // namespace

// --- Half-edges and their mates ---

HalfEdge Sewing::mate(HalfEdge h) const {
  const std::uint32_t code = at(h.layer).mates[h.index];
  if (code == none) return {};
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

// --- Edges ---

/// Joins the half-edges within a layer, but for those that lie in a slice.
void Sewing::pair_within(std::uint32_t layer) {
  State& state = at(layer);
  std::vector<std::uint32_t> starts;
  sort_out(state, starts);
  struct End {
    std::uint32_t high;
    std::uint32_t half_edge;
  };
  std::vector<End> ends(starts.back());
  for (std::uint32_t h = 3 * state.face_count; h-- > 0;) {
    const auto [low, high] = std::minmax({state.node(h), state.node(next(h))});
    if (state.is_in_slice(low, high)) continue;
    ends[--starts[low]] = {high, h};
  }
  for (std::size_t v = 0; v + 1 < starts.size(); ++v) {
    const auto around = std::span(ends).subspan(starts[v], starts[v + 1] - starts[v]);
    std::ranges::sort(around, [](const End& a, const End& b) {
      return a.high != b.high ? a.high < b.high : a.half_edge < b.half_edge;
    });
    for (std::size_t i = 0, j = 0; i < around.size(); i = j) {
      while (j < around.size() && around[j].high == around[i].high) ++j;
      if (j - i == 2) {
        state.mates[around[i].half_edge] = around[i + 1].half_edge;
        state.mates[around[i + 1].half_edge] = around[i].half_edge;
      } else if (j - i > 2) {
        std::vector<HalfEdge> edge;
        for (const End& end : around.subspan(i, j - i)) edge.push_back({layer, end.half_edge});
        pair_across_solid(std::move(edge), state.crowds);
      }
    }
  }
}

/// Counts corners; tells half-edges that lie in a slice from the others, and finds where the list
/// of those with a given smaller node ends.
void Sewing::sort_out(State& state, std::vector<std::uint32_t>& ends) {
  const auto node_count = state.contour_count + state.layer.tiles.inner.size();
  state.mates.assign(3 * state.face_count, none);
  state.corner_counts.assign(node_count, 0);
  state.first_corners.assign(node_count, none);
  ends.assign(node_count + 1, 0);
  for (std::uint32_t h = 3 * state.face_count; h-- > 0;) {
    const std::uint32_t a = state.node(h);
    const std::uint32_t b = state.node(next(h));
    ++state.corner_counts[a];
    state.first_corners[a] = h;
    if (!state.is_in_slice(a, b)) {
      ++ends[std::min(a, b)];
    } else {
      (a < state.lower_count ? state.lower_rim : state.upper_rim).push_back(h);
    }
  }
  std::partial_sum(ends.begin(), ends.end(), ends.begin());
}

/// Joins the half-edges that lie in the slice below a layer.
void Sewing::pair_at(std::uint32_t layer, Found& found) {
  if (pair_contours_at(layer)) return;
  std::vector<Ended> all;
  const auto gather = [&](std::uint32_t from, std::span<const std::uint32_t> rim) {
    for (const std::uint32_t index : rim) {
      const HalfEdge h{from, index};
      const auto [low, high] = std::minmax({vertex(h), vertex(next(h))});
      all.push_back({low, high, h});
    }
  };
  if (layer > 0) gather(layer - 1, at(layer - 1).upper_rim);
  if (has(layer)) gather(layer, at(layer).lower_rim);
  std::ranges::sort(all);
  for_each_edge(all, [&](const std::vector<HalfEdge>& edge) {
    if (edge.size() == 2) join(edge[0], edge[1]);
    if (edge.size() > 2) pair_across_solid(edge, found.crowds);
  });
}

/// The usual case: each point has one contour edge from it, with a tile below and one above.
/// Returns whether that was so.
bool Sewing::pair_contours_at(std::uint32_t layer) {
  if (layer == 0 || !has(layer)) return false;
  const State& below = at(layer - 1);
  const State& above = at(layer);
  if (below.upper_rim.size() != above.lower_rim.size()) return false;
  std::vector<std::uint32_t> leaving(above.lower_count, none);  // each point, above
  for (const std::uint32_t h : above.lower_rim) {
    std::uint32_t& here = leaving[above.node(h)];
    if (here != none) return false;
    here = h;
  }
  const auto point = [&](HalfEdge h) { return below.node(h.index) - below.lower_count; };
  for (const std::uint32_t index : below.upper_rim) {
    const HalfEdge h{layer - 1, index};
    const std::uint32_t opposite = leaving[point(next(h))];
    if (opposite == none || above.node(next(opposite)) != point(h)) return false;
  }
  for (const std::uint32_t index : below.upper_rim) {
    const HalfEdge h{layer - 1, index};
    join(h, {layer, leaving[point(next(h))]});
  }
  return true;
}

/// Around the edge p -> q, counter-clockwise, a face with the half-edge p -> q looks ahead: the
/// solid is between it and the face before it.
void Sewing::pair_across_solid(std::vector<HalfEdge> sorted, std::vector<Crowd>& crowds) {
  const HalfEdge first = sorted.front();
  const Vec3 p = place(first);
  const Vec3 q = place(next(first));
  const Vec3 reference = apex(first);
  const auto quarter = [&](HalfEdge h) {
    const Vec3 r = apex(h);
    const int side = orient3d(p, q, reference, r);
    if (side != 0) return side > 0 ? 1 : 3;
    return on_same_side(p, q, reference, r) ? 0 : 2;
  };
  std::ranges::sort(sorted, [&](HalfEdge a, HalfEdge b) {
    const int qa = quarter(a);
    const int qb = quarter(b);
    if (qa != qb) return qa < qb;
    return orient3d(p, q, apex(a), apex(b)) > 0;
  });
  const auto runs_along = [&](HalfEdge h) { return vertex(h) == vertex(first); };
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    const HalfEdge before = sorted[(i + sorted.size() - 1) % sorted.size()];
    if (runs_along(sorted[i]) && !runs_along(before)) join(sorted[i], before);
  }
  const auto [low, high] = std::minmax({vertex(first), vertex(next(first))});
  crowds.push_back({low, high, std::move(sorted)});
}

// --- Vertices ---

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
    slots_there.resize(at(of).corner_counts.size(), none);
    slots_there[node] = slot_count;
  };
  const Region& slice = has(layer) ? *at(layer).layer.lower : *at(layer - 1).layer.upper;
  for (std::uint32_t p = 0; p < slice.points.size(); ++p) {
    if (is_one_fan_at(layer, p)) continue;
    if (has(layer)) note(slots, layer, p);
    if (layer > 0) note(slots_below, layer - 1, at(layer - 1).lower_count + p);
    ++slot_count;
  }
  for (std::uint32_t n = has(layer) ? at(layer).contour_count : none;
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
      if (node < slots_there.size() && slots_there[node] != none)
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
  if (!is_doubled) return node < state.contour_count ? node : none;
  const auto [layer, point] = doubled_points_[node & number_bits];
  if (layer == corner.layer) return point;
  return layer == corner.layer + 1 ? state.lower_count + point : none;
}

void Sewing::set_node(HalfEdge corner, std::uint32_t node) {
  at(corner.layer).layer.tiles.tiles[corner.face()].nodes[corner.index % 3] = node;
}

// --- Double edges ---

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
  std::vector<HalfEdge> edges;
  for (HalfEdge h : crowd.half_edges) {
    h = latest(h);
    if (!mate(h).is_none() && h < mate(h)) edges.push_back(h);
  }
  std::ranges::sort(edges, {}, ends);
  if (std::ranges::adjacent_find(edges, {}, ends) == edges.end()) return;
  for (const HalfEdge h : edges) split_edge(h);
}

/// A midpoint on the edge of h: both its faces are cut in two.
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
  state.mates.resize(3 * tiles.size(), none);
  state.cuts.push_back(static_cast<std::uint32_t>(cut_faces_.size()));
  cut_faces_.push_back({h.layer, f});
  if (const HalfEdge beyond = mate(n); !beyond.is_none()) join({h.layer, 3 * f + 1}, beyond);
  set_node(n, middle);
  moved_[n] = {h.layer, 3 * f + 1};
  join(n, {h.layer, 3 * f + 2});
  return {h.layer, 3 * f};
}

}  // namespace loft
