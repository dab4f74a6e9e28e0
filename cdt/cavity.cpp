// SPDX-License-Identifier: MIT
#include <algorithm>

#include "cdt/predicates.h"
#include "cdt/triangulation.h"

namespace loft::cdt {

namespace {

/// Choosing the tips of that many vertices one after the other is still fast.
constexpr std::size_t small_cavity = 48;

}  // namespace

/// Makes the edge between two vertices over the unconstrained edges in crossed_: the triangles
/// these cut are taken out, and the hole on each side is filled anew (Anglada, "An Improved
/// Incremental Algorithm for Constructing Restricted Delaunay Triangulations", 1997).
EdgeId Triangulation::force_edge(VertexId from, VertexId to) {
  left_.chain.assign(1, from);
  right_.chain.assign(1, from);
  gather_cavity();
  left_.chain.push_back(to);
  right_.chain.push_back(to);
  std::ranges::reverse(right_.chain);
  std::ranges::reverse(right_.gaps);
  match_gaps();
  const EdgeId e = fill(left_);
  const EdgeId f = fill(right_);
  join(e, f);
  return e;
}

/// Lists the vertices on both sides of the crossed edges, the gaps between them, and the triangles
/// that are free for new use.
void Triangulation::gather_cavity() {
  left_.gaps.clear();
  right_.gaps.clear();
  spare_.clear();
  const EdgeId first = crossed_.front();
  spare_.push_back(triangle(first));
  add_gap(right_, prev(first), from(first));
  add_gap(left_, next(first), to(first));
  for (std::size_t i = 0; i + 1 < crossed_.size(); ++i) {
    const EdgeId f = twin(crossed_[i]);
    spare_.push_back(triangle(f));
    if (crossed_[i + 1] == next(f)) {
      add_gap(left_, prev(f), apex(f));
    } else {
      add_gap(right_, next(f), apex(f));
    }
  }
  const EdgeId f = twin(crossed_.back());
  spare_.push_back(triangle(f));
  left_.gaps.push_back({.inside = prev(f)});
  right_.gaps.push_back({.inside = next(f)});
}

void Triangulation::add_gap(Cavity& cavity, EdgeId inside, VertexId end) {
  cavity.gaps.push_back({.inside = inside});
  cavity.chain.push_back(end);
}

/// Finds what is beyond each gap: a triangle that stays, or, where an edge sticks out into the
/// cavity, the gap on its other side.
void Triangulation::match_gaps() {
  for (Cavity* cavity : {&left_, &right_}) {
    cavity->has_mates = false;
    for (Gap& gap : cavity->gaps) gap.beyond = side(gap.inside);
    // What was inside now says that it was, and at which gap.
    for (std::uint32_t i = 0; i < cavity->gaps.size(); ++i)
      edges_[cavity->gaps[i].inside.index()] = {VertexId::none(), i};
    for (Gap& gap : cavity->gaps) {
      const OrientedEdge& other = edges_[gap.beyond.bits & ~OrientedEdge::constrained];
      gap.has_mate = other.from.is_none();
      if (!gap.has_mate) continue;
      gap.mate = other.bits;
      cavity->has_mates = true;
    }
  }
}

/// Fills a cavity. Returns the edge from the chain's first vertex to its last, inside it.
EdgeId Triangulation::fill(Cavity& cavity) {
  if (cavity.chain.size() > small_cavity) return fill_large(cavity);
  return fill(cavity, 0, static_cast<std::uint32_t>(cavity.chain.size() - 1));
}

struct Triangulation::Workshop {
  Triangulation part;
  std::vector<Point> places;
  std::vector<VertexId> vertex_of;  // by vertex of the part
  std::vector<EdgeId> made;         // by edge of the part
  std::vector<EdgeId> front;
};

Triangulation::Workshop& Triangulation::Workshops::get() {
  if (!one_) one_ = std::make_shared<Workshop>();
  return *one_;
}

/// By a triangulation of the chain's vertices alone, with the chain as constraints: tips chosen one
/// by one would take quadratic time.
EdgeId Triangulation::fill_large(Cavity& cavity) {
  auto& [part, places, vertex_of, made, front] = workshop_.get();
  const std::size_t n = cavity.chain.size();
  places.resize(n);
  for (std::size_t i = 0; i < n; ++i) places[i] = point(cavity.chain[i]);
  part.clear();
  const auto segments = part.segments(part.insert(places, closed));
  vertex_of.resize(part.vertex_bound());
  for (std::size_t i = 0; i < n; ++i) vertex_of[segments[i].from.index()] = cavity.chain[i];

  // From the base inwards. The chain goes clockwise, the base from its first vertex to its last.
  const EdgeId base = *part.find_edge(segments[0].from, segments[n - 1].from);
  made.assign(part.edge_bound(), EdgeId::none());
  copy_triangle(base);
  while (!front.empty()) {
    const EdgeId e = front.back();
    front.pop_back();
    if (e == base) continue;
    const EdgeId f = part.twin(e);
    if (!part.is_constrained(e)) {
      if (made[f.index()].is_none()) copy_triangle(f);
      join(made[e.index()], made[f.index()]);
      continue;
    }
    // Along the chain backwards, with the cavity on the left.
    for (const Passage passage : part.passages(e))
      if (!part.is_forward(e, passage)) close(cavity, passage.segment().index(), made[e.index()]);
  }
  return made[base.index()];
}

/// The triangle left of an edge of the part, made here.
void Triangulation::copy_triangle(EdgeId e) {
  Workshop& work = workshop_.get();
  const auto corner = [&](EdgeId at) { return work.vertex_of[work.part.from(at).index()]; };
  const TriangleId t = spare_triangle(corner(e), corner(next(e)), corner(prev(e)));
  for (unsigned i = 0; i < 3; ++i, e = next(e)) {
    work.made[e.index()] = edge(t, i);
    work.front.push_back(e);
  }
}

/// One of the triangles that are free for new use, with new corners; its sides are yet to be
/// joined.
TriangleId Triangulation::spare_triangle(VertexId a, VertexId b, VertexId c) {
  const TriangleId t = spare_.back();
  spare_.pop_back();
  touch(t);
  const VertexId corners[3] = {a, b, c};
  for (unsigned i = 0; i < 3; ++i) {
    set_from(edge(t, i), corners[i]);
    vertex_edges_[corners[i].index()] = edge(t, i);
  }
  return t;
}

/// Fills the polygon that the chain from low to high closes with the edge between these two, on
/// its left. Returns that edge, inside the polygon.
EdgeId Triangulation::fill(Cavity& cavity, std::uint32_t low, std::uint32_t high) {
  const std::uint32_t tip = choose_tip(cavity, low, high);
  const TriangleId t = spare_triangle(cavity.chain[low], cavity.chain[high], cavity.chain[tip]);
  if (tip + 1 == high) {
    close(cavity, tip, edge(t, 1));
  } else {
    join(edge(t, 1), fill(cavity, tip, high));
  }
  if (low + 1 == tip) {
    close(cavity, low, edge(t, 2));
  } else {
    join(edge(t, 2), fill(cavity, low, tip));
  }
  return edge(t, 0);
}

/// The chain vertex whose circle with the two ends holds no other one.
std::uint32_t Triangulation::choose_tip(const Cavity& cavity, std::uint32_t low,
                                        std::uint32_t high) const {
  if (low + 2 == high) return low + 1;
  const auto& chain = cavity.chain;
  const Point a = point(chain[low]);
  const Point b = point(chain[high]);
  std::uint32_t tip = 0;
  for (std::uint32_t i = low + 1; i < high; ++i) {
    if (tip != 0 && chain[i] == chain[tip]) continue;
    if (orient(a, b, point(chain[i])) <= 0) continue;
    if (tip == 0 || in_circle_perturbed(a, b, point(chain[tip]), point(chain[i])) > 0) tip = i;
  }
  if (!cavity.has_mates) return tip;
  for (std::uint32_t i = tip; i < high; ++i)
    if (chain[i] == chain[tip] && opens_towards(cavity, i, chain[low], chain[high])) return i;
  return tip;
}

/// A vertex that edges stick out from occurs in the chain once for each sector between them: does
/// this occurrence look towards the edge from low to high?
bool Triangulation::opens_towards(const Cavity& cavity, std::uint32_t tip, VertexId low,
                                  VertexId high) const {
  const VertexId before = cavity.chain[tip - 1];
  const VertexId after = cavity.chain[tip + 1];
  if (before == after) return true;  // all around
  if (before == high && after == low) return false;
  const Point v = point(cavity.chain[tip]);
  const Point p = point(before);
  const Point q = point(after);
  const bool is_convex = orient(v, p, q) > 0;
  const auto is_in_sector = [&](Point d) {  // counter-clockwise from `before` to `after`
    if (is_convex) return orient(v, p, d) >= 0 && orient(v, d, q) >= 0;
    return orient(v, q, d) <= 0 || orient(v, d, p) <= 0;
  };
  return is_in_sector(point(low)) && is_in_sector(point(high));
}

/// Joins a new edge to what is beyond its gap.
void Triangulation::close(Cavity& cavity, std::uint32_t gap_index, EdgeId inside) {
  Gap& gap = cavity.gaps[gap_index];
  if (!gap.has_mate) {
    attach(inside, gap.beyond);
  } else if (const Gap& mate = cavity.gaps[gap.mate]; mate.inner.is_none()) {
    gap.inner = inside;
  } else {
    join(inside, mate.inner, gap.beyond.set);
  }
}

}  // namespace loft::cdt
