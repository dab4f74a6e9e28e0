// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "cdt/predicates.h"
#include "cdt/triangulation.h"

namespace loft::cdt {

namespace {

/// A segment may be led astray by rounding that often before it settles for existing edges.
constexpr int most_detours = 32;

}  // namespace

/// KBT, insert_segment: from vertex to vertex towards the end, splitting the constrained edges in
/// the way. A split point is off the straight line by its rounding, so each becomes a goal of its
/// own that is walked to anew.
void Triangulation::constrain(SegmentId s) {
  const Segment segment = this->segment(s);
  VertexId at = segment.from;
  goals_.assign(1, segment.to);
  const std::size_t snaps_before = snaps_;
  while (!goals_.empty()) {
    const VertexId goal = goals_.back();
    if (goal == at) {
      goals_.pop_back();
      continue;
    }
    if (snaps_ - snaps_before > most_detours) {
      follow_corridor(at, segment.to, s);
      return;
    }
    const Obstacle obstacle = walk(at, goal);
    switch (obstacle.kind) {
      case Obstacle::Kind::edge_along:
        mark(obstacle.edge, s);
        at = to(obstacle.edge);
        break;
      case Obstacle::Kind::constrained_edge:
        goals_.push_back(cross(obstacle.edge, s));
        break;
      case Obstacle::Kind::vertex:
        mark(force_edge(at, obstacle.vertex), s);
        at = obstacle.vertex;
        break;
    }
  }
}

/// Adds a passage of s along e, in the direction of e.
void Triangulation::mark(EdgeId e, SegmentId s) {
  link(e, twin(e), sets_.with(edges_[e.index()].set, Passage(s, is_upward(e))));
}

/// What is first in the way from one vertex straight to another. Fills crossed_ with the edges
/// crossed before that, each from right to left.
Triangulation::Obstacle Triangulation::walk(VertexId from, VertexId to) {
  crossed_.clear();
  Obstacle obstacle{};
  EdgeId e = first_crossed(from, to, obstacle);
  if (e.is_none()) return obstacle;
  for (;;) {
    if (is_constrained(e)) return {Obstacle::Kind::constrained_edge, e, {}};
    crossed_.push_back(e);
    const EdgeId f = twin(e);
    const VertexId ahead = apex(f);
    const int side = ahead == to ? 0 : orient(point(from), point(to), point(ahead));
    if (side == 0) return {Obstacle::Kind::vertex, EdgeId::none(), ahead};
    e = side > 0 ? next(f) : prev(f);
  }
}

/// The edge opposite to `from` that the straight line to `to` crosses first; none if it runs along
/// an edge, which then is the obstacle.
EdgeId Triangulation::first_crossed(VertexId from, VertexId to, Obstacle& obstacle) const {
  const Point start = point(from);
  const Point goal = point(to);
  const EdgeId first = edge(from);
  EdgeId e = first;
  int previous = 0;  // side of the last edge's end; 0 where there was none
  EdgeId before = EdgeId::none();
  // Once around, and the first edge again.
  for (bool is_last = false;; is_last = e == first) {
    const VertexId v = this->to(e);
    int side = 0;
    if (v == to) {
      obstacle = {Obstacle::Kind::edge_along, e, {}};
      return EdgeId::none();
    }
    if (v != infinite) {
      side = orient(start, goal, point(v));
      if (side == 0 && (start < goal) == (start < point(v))) {
        obstacle = {Obstacle::Kind::edge_along, e, {}};
        return EdgeId::none();
      }
    }
    if (previous < 0 && side > 0) return next(before);
    if (is_last) break;
    previous = side;
    before = e;
    e = rotated(e);
  }
  // Not reached: the hull is convex, so that some triangle around `from` faces `to`.
  obstacle = {Obstacle::Kind::edge_along, first, {}};
  return EdgeId::none();
}

/// Makes a vertex where segment s crosses the constrained edge e, or finds the vertex to go
/// through instead.
VertexId Triangulation::cross(EdgeId e, SegmentId s) {
  const std::optional<Point> place = crossing_point(e, s);
  if (!place) {
    const Point a = point(from(e));
    const Point b = point(to(e));
    return snap(e, {(a.x + b.x) / 2, (a.y + b.y) / 2});
  }
  for (const VertexId end : {from(e), to(e)})
    if (point(end) == *place) return end;
  if (!can_split(e, *place)) return snap(e, *place);

  const bool is_straight = orient(point(from(e)), point(to(e)), *place) == 0;
  const VertexId v = new_vertex(*place);
  split_edge(e, v);
  if (!is_straight) {
    push_star(v);
    restore_delaunay();
  }
  return v;
}

/// Where s crosses the segment that e is a piece of. Of several such segments that the
/// coordinates put first decides. None if rounding alone made s and e cross.
std::optional<Point> Triangulation::crossing_point(EdgeId e, SegmentId s) const {
  const auto ends = [&](SegmentId id) {
    const Segment& segment = this->segment(id);
    return std::minmax({point(segment.from), point(segment.to)});
  };
  const auto [a, b] = ends(s);
  std::optional<std::pair<Point, Point>> best;
  for (const Passage passage : passages(e)) {
    const std::pair<Point, Point> other = ends(passage.segment());
    if (crosses(a, b, other.first, other.second) && (!best || other < *best)) best = other;
  }
  if (!best) return {};
  return intersection(a, b, best->first, best->second);
}

/// The vertex of the two triangles beside e that is nearest to a place; e is led through it.
VertexId Triangulation::snap(EdgeId e, Point place) {
  ++snaps_;
  const auto distance = [&](VertexId v) {
    return std::hypot(point(v).x - place.x, point(v).y - place.y);
  };
  VertexId nearest = from(e);
  for (const VertexId v : {to(e), apex(e), apex(twin(e))})
    if (v != infinite && distance(v) < distance(nearest)) nearest = v;
  if (nearest != from(e) && nearest != to(e)) reroute(e, nearest);
  return nearest;
}

/// Moves the passages of e to the two edges that join its ends through an apex beside it.
void Triangulation::reroute(EdgeId e, VertexId through) {
  if (apex(e) != through) e = twin(e);
  const bool was_upward = is_upward(e);
  const PassageSet moved = edges_[e.index()].set;
  const std::vector<Passage> passages(sets_.view(moved).begin(), sets_.view(moved).end());
  for (const EdgeId side : {twin(prev(e)), twin(next(e))}) {  // from(e) -> apex -> to(e)
    PassageSet set = edges_[side.index()].set;
    for (const Passage passage : passages)
      set = sets_.with(set, is_upward(side) == was_upward ? passage : passage.reversed());
    link(side, twin(side), set);
  }
  link(e, twin(e), {});
  suspects_.push_back(e);
  restore_delaunay();
}

/// The last resort: marks the existing edges left of the straight line. Always possible.
void Triangulation::follow_corridor(VertexId at, VertexId goal, SegmentId s) {
  while (at != goal) {
    Obstacle obstacle{};
    EdgeId e = first_crossed(at, goal, obstacle);
    if (e.is_none()) {
      mark(obstacle.edge, s);
      at = to(obstacle.edge);
      continue;
    }
    const Point start = point(at);
    mark(twin(next(e)), s);
    at = to(e);
    for (;;) {  // e goes from right to left, `at` is its left end
      const EdgeId f = twin(e);
      const VertexId ahead = apex(f);
      const int side = ahead == goal ? 0 : orient(start, point(goal), point(ahead));
      if (side >= 0) {
        mark(twin(prev(f)), s);
        at = ahead;
      }
      if (side == 0) break;
      e = side > 0 ? next(f) : prev(f);
    }
  }
}

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
  const auto last = [](const Cavity& cavity) {
    return static_cast<std::uint32_t>(cavity.chain.size() - 1);
  };
  const EdgeId e = fill(left_, 0, last(left_));
  const EdgeId f = fill(right_, 0, last(right_));
  link(e, f);
  return e;
}

/// Lists the vertices on both sides of the crossed edges, the gaps between them, and the triangles
/// that are free for new use.
void Triangulation::gather_cavity() {
  for (Cavity* cavity : {&left_, &right_}) {
    cavity->gaps.clear();
    cavity->has_mates = false;
  }
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
  left_.gaps.push_back({prev(f), 0, EdgeId::none(), {}});
  right_.gaps.push_back({next(f), 0, EdgeId::none(), {}});
}

void Triangulation::add_gap(Cavity& cavity, EdgeId inside, VertexId end) {
  cavity.gaps.push_back({inside, 0, EdgeId::none(), {}});
  cavity.chain.push_back(end);
}

/// Finds what is beyond each gap: a triangle that stays, or, where an edge sticks out into the
/// cavity, the gap on its other side. So far `outer` is the edge inside the cavity.
void Triangulation::match_gaps() {
  constexpr std::uint32_t flag = 0x8000'0000;
  for (Cavity* cavity : {&left_, &right_}) {
    for (std::uint32_t i = 0; i < cavity->gaps.size(); ++i) {
      Gap& gap = cavity->gaps[i];
      const OrientedEdge inside = edges_[gap.outer.index()];
      gap.set = inside.set;
      if ((inside.twin.index() & flag) != 0) {
        gap.outer = EdgeId::none();
        gap.mate = inside.twin.index() & ~flag;
        cavity->gaps[gap.mate].outer = EdgeId::none();
        cavity->gaps[gap.mate].mate = i;
        cavity->has_mates = true;
      } else {
        edges_[inside.twin.index()].twin = EdgeId(i | flag);
        gap.outer = inside.twin;
      }
    }
  }
}

/// Fills the polygon that the chain from low to high closes with the edge between these two, on
/// its left. Returns that edge, inside the polygon.
EdgeId Triangulation::fill(Cavity& cavity, std::uint32_t low, std::uint32_t high) {
  const std::uint32_t tip = choose_tip(cavity, low, high);
  const TriangleId t = spare_.back();
  spare_.pop_back();
  const VertexId corners[3] = {cavity.chain[low], cavity.chain[high], cavity.chain[tip]};
  for (unsigned i = 0; i < 3; ++i) {
    set_edge(edge(t, i), corners[i]);
    vertex_edges_[corners[i].index()] = edge(t, i);
  }
  if (tip + 1 == high) {
    close(cavity, tip, edge(t, 1));
  } else {
    link(edge(t, 1), fill(cavity, tip, high));
  }
  if (low + 1 == tip) {
    close(cavity, low, edge(t, 2));
  } else {
    link(edge(t, 2), fill(cavity, low, tip));
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
  if (!gap.outer.is_none()) {
    link(inside, gap.outer, gap.set);
  } else if (Gap& mate = cavity.gaps[gap.mate]; mate.inner.is_none()) {
    gap.inner = inside;
  } else {
    link(inside, mate.inner, gap.set);
  }
}

}  // namespace loft::cdt
