// SPDX-License-Identifier: MIT
// Sewing: which half-edges belong together, within a layer and where two layers meet.
#include <algorithm>
#include <compare>
#include <numeric>
#include <utility>

#include "cdt/predicates.h"
#include "mesh/predicates.h"
#include "reconstruct/sew/sewing.h"

namespace loft {

namespace {

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
  state.mates.assign(3 * state.face_count, Origin::none);
  state.corner_counts.assign(node_count, 0);
  state.first_corners.assign(node_count, Origin::none);
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
  if (layer == 0 || !has(layer) || at(layer).layer.lower->line_count() != 0) return false;
  const State& below = at(layer - 1);
  const State& above = at(layer);
  if (below.upper_rim.size() != above.lower_rim.size()) return false;
  std::vector<std::uint32_t> leaving(above.lower_count, Origin::none);  // each point, above
  for (const std::uint32_t h : above.lower_rim) {
    std::uint32_t& here = leaving[above.node(h)];
    if (here != Origin::none) return false;
    here = h;
  }
  const auto point = [&](HalfEdge h) { return below.node(h.index) - below.lower_count; };
  for (const std::uint32_t index : below.upper_rim) {
    const HalfEdge h{layer - 1, index};
    const std::uint32_t opposite = leaving[point(next(h))];
    if (opposite == Origin::none || above.node(next(opposite)) != point(h)) return false;
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

}  // namespace loft
