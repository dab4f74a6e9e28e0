// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "cdt/predicates.h"
#include "cdt/triangulation.h"

namespace loft::cdt {

namespace {

constexpr double never = std::numeric_limits<double>::infinity();

/// With so many corners a heap finds the next ear faster than looking at all.
constexpr std::uint32_t large_hole = 32;

}  // namespace

/// Takes out a vertex without constrained edges, and fills the hole.
void Triangulation::delete_vertex(VertexId v) {
  if (is_flat_) {
    delete_from_line(v);
    return;
  }
  const Point centre = point(v);
  const VertexId neighbour = to(edge(v)) == infinite ? to(rotated(edge(v))) : to(edge(v));
  if (!fill_small_hole(v)) {
    gather_hole(v);
    cut_ears(centre);
  }
  for (const TriangleId t : spare_) free_triangle(t);
  locator_.replace(v, centre, neighbour);
  free_vertex(v);
  restore_delaunay();
}

/// Where a hole has few corners, triangle by triangle: the tip beyond an edge is the corner whose
/// circle with the edge holds no other. All triangles are chosen before anything is changed: that
/// they are counter-clockwise is what shows that they fill the hole, as constraints around it may
/// stand between an edge and its tip. Nothing happens if they are not, or at the hull.
bool Triangulation::fill_small_hole(VertexId v) {
  const EdgeId first = edge(v);
  EdgeId last = first;
  std::uint32_t degree = 0;
  do {
    if (to(last) == infinite || ++degree > most_planned) return false;
    last = rotated(last);
  } while (last != first);
  last = next(twin(first));  // the one before the first, all around
  gather_half(left_, first, last);
  if (!plan(left_, 0, degree - 1)) return false;
  gather_star(v);
  const Side base = side(next(last));
  attach(fill_planned(left_, 0, degree - 1), base);
  last_ = edge(left_.chain[0]);
  return true;
}

/// Chooses the tips for the part of a hole that the chain from low to high closes.
bool Triangulation::plan(const Cavity& cavity, std::uint32_t low, std::uint32_t high) {
  if (low + 1 == high) return true;
  std::uint32_t tip = 0;
  const Point a = point(cavity.chain[low]);
  const Point b = point(cavity.chain[high]);
  for (std::uint32_t i = low + 1; i < high; ++i) {
    const Point c = point(cavity.chain[i]);
    if (orient(a, b, c) <= 0) continue;
    if (tip == 0 || in_circle_perturbed(a, b, point(cavity.chain[tip]), c) > 0) tip = i;
  }
  if (tip == 0) return false;
  tips_[low][high] = tip;
  return plan(cavity, low, tip) && plan(cavity, tip, high);
}

EdgeId Triangulation::fill_planned(Cavity& cavity, std::uint32_t low, std::uint32_t high) {
  const std::uint32_t tip = tips_[low][high];
  const TriangleId t = spare_triangle(cavity.chain[low], cavity.chain[high], cavity.chain[tip]);
  if (tip + 1 == high) {
    attach(edge(t, 1), cavity.gaps[tip].beyond);
  } else {
    join(edge(t, 1), fill_planned(cavity, tip, high));
  }
  if (low + 1 == tip) {
    attach(edge(t, 2), cavity.gaps[low].beyond);
  } else {
    join(edge(t, 2), fill_planned(cavity, low, tip));
  }
  return edge(t, 0);
}

/// The triangles around a vertex are free for new use.
void Triangulation::gather_star(VertexId v) {
  spare_.clear();
  const EdgeId first = edge(v);
  EdgeId e = first;
  do {
    spare_.push_back(triangle(e));
    e = rotated(e);
  } while (e != first);
}

/// Lists the corners around a vertex, counter-clockwise, and the triangles to use again.
void Triangulation::gather_hole(VertexId v) {
  corners_.clear();
  spare_.clear();
  const EdgeId first = edge(v);
  EdgeId e = first;
  do {
    const auto i = static_cast<std::uint32_t>(corners_.size());
    corners_.push_back({to(e), side(next(e)), i + 1, i - 1, never});
    spare_.push_back(triangle(e));
    e = rotated(e);
  } while (e != first);
  corners_.front().prev = static_cast<std::uint32_t>(corners_.size() - 1);
  corners_.back().next = 0;
}

/// How high the vertex has to be lifted for the ear at this corner to appear.
void Triangulation::rate(std::uint32_t i, Point centre) {
  Corner& corner = corners_[i];
  corner.urgency = never;
  const VertexId before = corners_[corner.prev].vertex;
  const VertexId after = corners_[corner.next].vertex;
  if (corner.vertex == infinite || before == infinite || after == infinite) return;
  const Point a = point(before);
  const Point b = point(corner.vertex);
  const Point c = point(after);
  const double ax = a.x - centre.x, ay = a.y - centre.y;
  const double bx = b.x - centre.x, by = b.y - centre.y;
  const double cx = c.x - centre.x, cy = c.y - centre.y;
  const double bc = bx * cy - cx * by;
  const double ca = cx * ay - ax * cy;
  const double ab = ax * by - bx * ay;
  if (orient(a, b, c) <= 0 || orient(a, c, centre) < 0) return;
  const double height =
      (ax * ax + ay * ay) * bc + (bx * bx + by * by) * ca + (cx * cx + cy * cy) * ab;
  const double urgency = height / (bc + ca + ab);
  corner.urgency = std::isfinite(urgency) ? urgency : std::numeric_limits<double>::max();
}

/// Fills the hole ear by ear, in the order in which ears would appear if the vertex were lifted off
/// the paraboloid (Devillers, "On Deletion in Delaunay Triangulations", 1999). That order is
/// computed in floating point; flips mend what it gets wrong, and decide ties.
/// Cuts until a triangle is left, or, at the hull, a chain that is convex towards infinity.
void Triangulation::cut_ears(Point centre) {
  auto remaining = static_cast<std::uint32_t>(corners_.size());
  std::uint32_t some = 0;
  if (remaining > 3)
    for (std::uint32_t i = 0; i < remaining; ++i) rate(i, centre);
  const bool is_large = remaining > large_hole;
  ears_.clear();
  const auto queue = [&](std::uint32_t i) {
    if (!is_large || corners_[i].urgency == never) return;
    ears_.push_back({corners_[i].urgency, i});
    std::ranges::push_heap(ears_, std::greater<>());
  };
  const auto next_ear = [&] {
    std::uint32_t best = some;
    if (!is_large) {
      for (std::uint32_t i = corners_[some].next; i != some; i = corners_[i].next)
        if (corners_[i].urgency < corners_[best].urgency) best = i;
      return best;
    }
    while (!ears_.empty()) {
      std::ranges::pop_heap(ears_, std::greater<>());
      const Ear ear = ears_.back();
      ears_.pop_back();
      if (corners_[ear.corner].urgency == ear.urgency) return ear.corner;
    }
    return best;
  };
  for (std::uint32_t i = 0; is_large && i < remaining; ++i) queue(i);
  while (remaining > 3) {
    const std::uint32_t ear = next_ear();
    if (corners_[ear].urgency == never) break;
    const std::uint32_t before = corners_[ear].prev;
    const std::uint32_t after = corners_[ear].next;
    cut_ear(ear);
    corners_[ear].urgency = never;
    some = before;
    if (--remaining == 3) break;
    rate(before, centre);
    rate(after, centre);
    queue(before);
    queue(after);
  }
  close_hole(some);
}

/// The triangle of a corner and its two neighbours; the corner is then out of the ring.
void Triangulation::cut_ear(std::uint32_t i) {
  const Corner& ear = corners_[i];
  Corner& before = corners_[ear.prev];
  const TriangleId t = spare_triangle(before.vertex, ear.vertex, corners_[ear.next].vertex);
  attach(edge(t, 0), before.side);
  attach(edge(t, 1), ear.side);
  suspects_.push_back(edge(t, 2));
  before.side = {edge(t, 2).index(), {}};
  before.next = ear.next;
  corners_[ear.next].prev = ear.prev;
}

/// Three corners are a triangle. More are what the hull now runs along: each side of theirs gets an
/// infinite triangle.
void Triangulation::close_hole(std::uint32_t some) {
  std::uint32_t start = some;
  do {
    if (corners_[start].vertex == infinite) break;
    start = corners_[start].next;
  } while (start != some);
  const Corner corner = corners_[start];
  std::uint32_t i = corner.next;
  // A fan around the first corner: with three corners it is one triangle.
  Side previous = corner.side;
  bool is_flat = corner.vertex == infinite;
  for (; corners_[i].next != start; i = corners_[i].next) {
    const Corner& x = corners_[i];
    const TriangleId t = spare_triangle(corner.vertex, x.vertex, corners_[x.next].vertex);
    is_flat = is_flat && is_infinite(TriangleId((x.side.bits & ~OrientedEdge::constrained) / 3));
    attach(edge(t, 0), previous);
    attach(edge(t, 1), x.side);
    previous = {edge(t, 2).index(), {}};
  }
  attach(EdgeId(previous.bits & ~OrientedEdge::constrained), corners_[i].side);
  last_ = edge(corners_[i].vertex == infinite ? corner.vertex : corners_[i].vertex);
  is_flat_ = is_flat;
}

// --- A vertex on a straight line ---

/// Takes out a vertex at which two constrained edges meet that are one without it; both go out from
/// it. The holes on the two sides of the line are filled as those beside a new segment. If rounding
/// had bent the line, what was hidden behind the bend may be seen now: the rim of the hole is
/// suspect then. Nothing happens if a corner of the hole is not strictly beside the line.
bool Triangulation::delete_between(VertexId v, EdgeId to_start, EdgeId to_end) {
  if (is_flat_) {
    const PassageSet set = side(to_start).set;
    const VertexId start = to(to_start);
    const VertexId end = to(to_end);
    sets_.release(side(to_end).set);
    join(to_start, twin(to_start));
    join(to_end, twin(to_end));
    delete_from_line(v);
    const EdgeId e = edge_between(start, end);
    join(e, twin(e), set);
    return true;
  }
  gather_half(left_, to_end, to_start);
  gather_half(right_, to_start, to_end);
  if (!is_beside(left_) || !is_beside(right_)) return false;
  const VertexId start = to(to_start);
  const VertexId end = to(to_end);
  const Side kept = side(to_start);
  const bool was_upward = is_upward(twin(to_start));
  sets_.release(side(to_end).set);
  const Point place = point(v);
  gather_star(v);
  match_gaps();
  const EdgeId there = fill(left_);
  const EdgeId back = fill(right_);
  const bool is_upward = point(start) < point(end);
  join(there, back, is_upward == was_upward ? kept.set : sets_.reversed(kept.set));
  for (const TriangleId t : spare_) free_triangle(t);
  locator_.replace(v, place, start);
  free_vertex(v);
  last_ = there;
  if (orient(point(start), point(end), place) != 0) {
    suspect_rim(left_);
    suspect_rim(right_);
    restore_delaunay();
  }
  return true;
}

/// The edges around a filled hole may not be Delaunay.
void Triangulation::suspect_rim(const Cavity& cavity) {
  for (const Gap& gap : cavity.gaps)
    suspects_.push_back(EdgeId(gap.beyond.bits & ~OrientedEdge::constrained));
}

/// The chain around a vertex from the end of one of its edges counter-clockwise to that of another,
/// turned so that it goes clockwise.
void Triangulation::gather_half(Cavity& cavity, EdgeId first, EdgeId last) {
  cavity.chain.assign(1, to(first));
  cavity.gaps.clear();
  for (EdgeId e = first; e != last; e = rotated(e)) {
    cavity.gaps.push_back({.inside = next(e), .beyond = side(next(e))});
    cavity.chain.push_back(to(next(e)));
  }
  std::ranges::reverse(cavity.chain);
  std::ranges::reverse(cavity.gaps);
}

/// Whether a chain has something between its ends, all strictly left of the line from its first to
/// its last vertex: finite, or nothing but infinity.
bool Triangulation::is_beside(const Cavity& cavity) const {
  const auto& chain = cavity.chain;
  if (chain.size() == 2) return false;
  if (chain.size() == 3 && chain[1] == infinite) return true;
  return std::all_of(chain.begin() + 1, chain.end() - 1, [&](VertexId v) {
    return v != infinite && orient(point(chain.front()), point(chain.back()), point(v)) > 0;
  });
}

/// Takes out a vertex while all are in one line.
void Triangulation::delete_from_line(VertexId v) {
  locator_.replace(v, point(v), VertexId::none());
  const EdgeId first = edge(v);
  if (first.is_none()) {
    free_vertex(v);
    only_ = VertexId::none();
    return;
  }
  const EdgeId e = to(first) == infinite ? rotated(first) : first;
  const EdgeId f = twin(e);
  const VertexId a = to(e);
  if (vertex_count() == 2) {
    free_triangle(triangle(e));
    free_triangle(triangle(f));
    vertex_edges_[a.index()] = EdgeId::none();
    vertex_edges_[infinite.index()] = EdgeId::none();
    only_ = a;
    last_ = EdgeId::none();
    free_vertex(v);
    return;
  }
  const EdgeId g = rotated(rotated(e));
  if (g == e) {  // the end of the line
    const EdgeId in = twin(next(e));
    const EdgeId out = twin(prev(f));
    touch(triangle(in));
    touch(triangle(out));
    free_triangle(triangle(e));
    free_triangle(triangle(f));
    join(in, out);
    vertex_edges_[a.index()] = out;
    vertex_edges_[infinite.index()] = in;
    last_ = out;
  } else {  // a, v, b become a, b
    const EdgeId h = twin(g);
    const EdgeId beyond_a = twin(next(e));
    const EdgeId beyond_b = twin(next(g));
    const VertexId b = to(g);
    touch(triangle(f));
    touch(triangle(h));
    touch(triangle(beyond_a));
    touch(triangle(beyond_b));
    free_triangle(triangle(e));
    free_triangle(triangle(g));
    set_from(next(f), b);
    set_from(next(h), a);
    join(f, h);
    join(next(f), beyond_b);
    join(next(h), beyond_a);
    vertex_edges_[a.index()] = f;
    vertex_edges_[b.index()] = h;
    vertex_edges_[infinite.index()] = prev(f);
    last_ = f;
  }
  free_vertex(v);
}

}  // namespace loft::cdt
