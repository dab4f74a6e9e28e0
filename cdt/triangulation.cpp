// SPDX-License-Identifier: MIT
#include "cdt/triangulation.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "cdt/predicates.h"

namespace loft::cdt {

void Triangulation::clear() {
  edges_.clear();
  points_.assign(
      1, Point{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()});
  vertex_edges_.assign(1, EdgeId::none());
  constraints_.clear();
  segments_.clear();
  sets_.clear();
  last_ = EdgeId::none();
  is_flat_ = true;
  snaps_ = 0;
}

void Triangulation::reserve(std::size_t vertices) {
  points_.reserve(vertices + 1);
  vertex_edges_.reserve(vertices + 1);
  edges_.reserve(6 * vertices);
  segments_.reserve(vertices);
}

ConstraintId Triangulation::insert(std::span<const Point> points, Ends ends) {
  if (points.empty()) throw std::invalid_argument("a constraint needs a point");
  const auto is_usable = [](double x) { return std::abs(x) <= largest_coordinate; };
  for (const Point p : points)
    if (!is_usable(p.x) || !is_usable(p.y))
      throw std::invalid_argument("a constraint needs coordinates that are finite and below 1e75");

  const ConstraintId id(static_cast<std::uint32_t>(constraints_.size()));
  const auto first_segment = static_cast<std::uint32_t>(segments_.size());
  insert_points(points);
  for (std::size_t i = 1; i < points.size(); ++i)
    segments_.push_back({inserted_[i - 1], inserted_[i], id});
  if (ends == closed && points.size() > 1)
    segments_.push_back({inserted_.back(), inserted_.front(), id});
  const VertexId first = inserted_.front();
  const auto end = static_cast<std::uint32_t>(segments_.size());
  constraints_.push_back({first, first_segment, end - first_segment});
  for (std::uint32_t s = first_segment; s < end; ++s) constrain(SegmentId(s));
  return id;
}

/// Coarse to fine: every 2^k-th point, then those half way between, each located from its
/// neighbour. Along a curve, in the order of the curve, most flips would be undone by later ones.
void Triangulation::insert_points(std::span<const Point> points) {
  const std::size_t n = points.size();
  inserted_.resize(n);
  inserted_[0] = insert(points[0]);
  for (std::size_t stride = std::bit_floor(n); stride > 0; stride /= 2)
    for (std::size_t i = stride; i < n; i += 2 * stride)
      inserted_[i] = insert_near(points[i], edge(inserted_[i - stride]));
}

VertexId Triangulation::insert(Point point) { return insert_near(point, last_); }

std::optional<VertexId> Triangulation::split(EdgeId e, Point point) {
  if (!can_split(e, point)) return {};
  const VertexId v = new_vertex(point);
  split_edge(e, v);
  return v;
}

std::optional<VertexId> Triangulation::split(TriangleId t, Point point) {
  if (is_infinite(t)) return {};
  for (unsigned corner = 0; corner < 3; ++corner) {
    const EdgeId e = edge(t, corner);
    if (orient(this->point(from(e)), this->point(to(e)), point) <= 0) return {};
  }
  const VertexId v = new_vertex(point);
  split_triangle(t, v);
  return v;
}

std::optional<EdgeId> Triangulation::find_edge(VertexId a, VertexId b) const {
  const EdgeId first_at_a = edge(a);
  const EdgeId first_at_b = edge(b);
  if (first_at_a.is_none()) return {};
  EdgeId e = first_at_a;
  EdgeId f = first_at_b;
  do {  // around both in step
    if (to(e) == b) return e;
    if (to(f) == a) return twin(f);
    e = rotated(e);
    f = rotated(f);
  } while (e != first_at_a && f != first_at_b);
  return {};
}

std::span<const Segment> Triangulation::segments(ConstraintId c) const {
  const Constraint& constraint = constraints_[c.index()];
  return {segments_.data() + constraint.first_segment, constraint.segment_count};
}

SegmentId Triangulation::first_segment(ConstraintId c) const {
  return SegmentId(constraints_[c.index()].first_segment);
}

/// Hierholzer's way to find a trail: rounding may have led the segment in loops.
std::vector<EdgeId> Triangulation::pieces(SegmentId s) const {
  std::vector<EdgeId> used;
  const auto is_open = [&](EdgeId e) {
    const auto available = std::ranges::count_if(passages(e), [&](Passage passage) {
      return passage.segment() == s && is_forward(e, passage);
    });
    return available > 0 && available > std::ranges::count(used, e);
  };
  const auto open_edge = [&](VertexId v) {
    const EdgeId first = edge(v);
    EdgeId e = first;
    do {
      if (is_open(e)) return e;
      e = rotated(e);
    } while (e != first);
    return EdgeId::none();
  };
  std::vector<EdgeId> trail;
  std::vector<EdgeId> found;
  VertexId at = segment(s).from;
  if (at == segment(s).to) return found;
  for (;;) {
    if (const EdgeId e = open_edge(at); !e.is_none()) {
      used.push_back(e);
      trail.push_back(e);
      at = to(e);
    } else if (!trail.empty()) {
      found.push_back(trail.back());
      at = from(trail.back());
      trail.pop_back();
    } else {
      break;
    }
  }
  std::ranges::reverse(found);
  return found;
}

TriangleId Triangulation::new_triangle() {
  const TriangleId t(static_cast<std::uint32_t>(triangle_count()));
  edges_.resize(edges_.size() + 3);
  return t;
}

VertexId Triangulation::new_vertex(Point point) {
  const VertexId v(static_cast<std::uint32_t>(points_.size()));
  points_.push_back(point);
  vertex_edges_.emplace_back();
  return v;
}

void Triangulation::link(EdgeId a, EdgeId b, PassageSet set) {
  edges_[a.index()].twin = b;
  edges_[b.index()].twin = a;
  edges_[a.index()].set = set;
  edges_[b.index()].set = set;
}

VertexId Triangulation::insert_near(Point point, EdgeId hint) {
  const Location place = locate(point, hint);
  VertexId v;
  switch (place.kind) {
    case Location::Kind::vertex:
      last_ = place.edge;
      return from(place.edge);
    case Location::Kind::edge:
      v = new_vertex(point);
      split_edge(place.edge, v);
      break;
    case Location::Kind::triangle:
      v = new_vertex(point);
      split_triangle(triangle(place.edge), v);
      break;
    case Location::Kind::outside:
      v = new_vertex(point);
      if (to(place.edge) == infinite) {
        extend(place.edge, v);
      } else {
        is_flat_ = false;
        split_triangle(triangle(place.edge), v);
      }
      break;
    case Location::Kind::nowhere:
      if (vertex_count() == 1 && points_.back() == point) return VertexId(1);
      v = new_vertex(point);
      if (vertex_count() == 2) start(VertexId(1), v);
      break;
  }
  last_ = edge(v);
  return v;
}

/// An edge with an infinite triangle on each side, whose edges to and from infinity are still open.
/// Returns the edges a -> b and b -> a.
std::pair<EdgeId, EdgeId> Triangulation::add_flat_edge(VertexId a, VertexId b) {
  const EdgeId there = edge(new_triangle());
  const EdgeId back = edge(new_triangle());
  set_edge(there, a);
  set_edge(next(there), b);
  set_edge(prev(there), infinite);
  set_edge(back, b);
  set_edge(next(back), a);
  set_edge(prev(back), infinite);
  link(there, back);
  link(next(there), prev(back));
  vertex_edges_[b.index()] = back;
  return {there, back};
}

/// The first two vertices.
void Triangulation::start(VertexId a, VertexId b) {
  const auto [there, back] = add_flat_edge(a, b);
  link(prev(there), next(back));
  vertex_edges_[a.index()] = there;
  vertex_edges_[infinite.index()] = prev(there);
}

/// While all vertices are in one line: one more beyond the end that `end` leaves to infinity.
void Triangulation::extend(EdgeId end, VertexId v) {
  const EdgeId end_back = twin(end);
  const auto [there, back] = add_flat_edge(from(end), v);
  link(prev(there), end);
  link(next(back), end_back);
}

/// Every triangle that a split makes has the new vertex at corner 2, and the edge that may need a
/// flip at corner 0.
void Triangulation::split_triangle(TriangleId t, VertexId v) {
  const EdgeId old[3] = {edge(t, 0), edge(t, 1), edge(t, 2)};
  const OrientedEdge sides[3] = {edges_[old[0].index()], edges_[old[1].index()],
                                 edges_[old[2].index()]};
  const TriangleId parts[3] = {t, new_triangle(), new_triangle()};
  for (unsigned i = 0; i < 3; ++i) {
    set_edge(edge(parts[i], 0), sides[i].from);
    set_edge(edge(parts[i], 1), sides[(i + 1) % 3].from);
    set_edge(edge(parts[i], 2), v);
    link(edge(parts[i], 0), sides[i].twin, sides[i].set);
    vertex_edges_[sides[i].from.index()] = edge(parts[i], 0);
    suspects_.push_back(edge(parts[i], 0));
  }
  for (unsigned i = 0; i < 3; ++i) link(edge(parts[i], 1), edge(parts[(i + 1) % 3], 2));
  vertex_edges_[v.index()] = edge(t, 2);
  fan_out(v);
}

void Triangulation::split_edge(EdgeId e, VertexId v) {
  const EdgeId f = twin(e);
  const VertexId a = from(e);
  const VertexId b = from(f);
  const VertexId c = apex(e);
  const VertexId d = apex(f);
  const EdgeId old[4] = {prev(e), next(e), prev(f), next(f)};
  OrientedEdge sides[4];
  for (unsigned i = 0; i < 4; ++i) sides[i] = edges_[old[i].index()];
  const PassageSet set = edges_[e.index()].set;
  const bool was_upward = !set.is_empty() && is_upward(e);

  // Around v, clockwise: (c, a, v), (b, c, v), (d, b, v), (a, d, v).
  const VertexId starts[4] = {c, b, d, a};
  const VertexId ends[4] = {a, c, b, d};
  const TriangleId parts[4] = {triangle(e), new_triangle(), triangle(f), new_triangle()};
  for (unsigned i = 0; i < 4; ++i) {
    set_edge(edge(parts[i], 0), starts[i]);
    set_edge(edge(parts[i], 1), ends[i]);
    set_edge(edge(parts[i], 2), v);
  }
  for (unsigned i = 0; i < 4; ++i) {
    // At the end of a line of vertices the two infinite triangles are neighbours twice.
    for (unsigned j = 0; is_flat_ && j < 4; ++j)
      if (sides[i].twin == old[j]) sides[i].twin = edge(parts[j], 0);
    link(edge(parts[i], 0), sides[i].twin, sides[i].set);
    vertex_edges_[starts[i].index()] = edge(parts[i], 0);
    suspects_.push_back(edge(parts[i], 0));
  }
  // A rounded point may lie beyond the ends in the lexicographic order: turn the passages then.
  const auto half = [&](VertexId low, VertexId high) {
    const bool upward = !set.is_empty() && point(low) < point(high);
    return upward == was_upward ? set : sets_.reversed(set);
  };
  link(edge(parts[0], 2), edge(parts[1], 1));              // v-c
  link(edge(parts[1], 2), edge(parts[2], 1), half(v, b));  // v-b
  link(edge(parts[2], 2), edge(parts[3], 1));              // v-d
  link(edge(parts[3], 2), edge(parts[0], 1), half(a, v));  // v-a
  vertex_edges_[v.index()] = edge(parts[0], 2);
  fan_out(v);
}

/// Flips edges opposite to the new vertex v, listed in suspects_, until they are Delaunay
/// (Lawson). Each is at corner 0 of its triangle, v at corner 2; flips keep it so.
void Triangulation::fan_out(VertexId v) {
  while (!suspects_.empty()) {
    const EdgeId e = suspects_.back();
    suspects_.pop_back();
    if (is_constrained(e)) continue;
    const EdgeId f = twin(e);
    const VertexId a = from(e);
    const VertexId b = from(f);
    const VertexId d = apex(f);
    if (!should_flip(a, b, v, d)) continue;

    const OrientedEdge ad = edges_[next(f).index()];
    const OrientedEdge db = edges_[prev(f).index()];
    const OrientedEdge bv = edges_[next(e).index()];
    const TriangleId t = triangle(e);
    const TriangleId u = triangle(f);
    set_edge(edge(t, 1), d);
    link(edge(t, 0), ad.twin, ad.set);
    set_edge(edge(u, 0), d);
    set_edge(edge(u, 1), b);
    set_edge(edge(u, 2), v);
    link(edge(u, 0), db.twin, db.set);
    link(edge(u, 1), bv.twin, bv.set);
    link(edge(t, 1), edge(u, 2));
    vertex_edges_[a.index()] = edge(t, 0);
    vertex_edges_[b.index()] = edge(u, 1);
    vertex_edges_[d.index()] = edge(u, 0);
    suspects_.push_back(edge(t, 0));
    suspects_.push_back(edge(u, 0));
  }
}

bool Triangulation::can_split(EdgeId e, Point p) const {
  const EdgeId around[4] = {next(e), prev(e), next(twin(e)), prev(twin(e))};
  for (const EdgeId side : around) {
    if (from(side) == infinite || to(side) == infinite) continue;
    if (orient(point(from(side)), point(to(side)), p) <= 0) return false;
  }
  return from(e) != infinite && to(e) != infinite;
}

/// Whether the edge ab between the triangles (a, b, c) and (b, a, d) is not Delaunay. An infinite
/// corner stands for a point so far away that circles through it are straight lines.
bool Triangulation::should_flip(VertexId a, VertexId b, VertexId c, VertexId d) const {
  if (c == infinite || d == infinite) return false;
  if (a == infinite) return orient(point(d), point(b), point(c)) > 0;
  if (b == infinite) return orient(point(c), point(a), point(d)) > 0;
  return in_circle_perturbed(point(a), point(b), point(c), point(d)) > 0;
}

/// Turns the diagonal of the two triangles beside e, which must make a convex quadrilateral.
void Triangulation::flip(EdgeId e) {
  const EdgeId f = twin(e);
  const VertexId a = from(e);
  const VertexId b = from(f);
  const VertexId c = apex(e);
  const VertexId d = apex(f);
  const OrientedEdge bc = edges_[next(e).index()];
  const OrientedEdge ad = edges_[next(f).index()];
  const EdgeId dc = next(e);
  const EdgeId cd = next(f);
  link(e, ad.twin, ad.set);  // a -> d
  set_edge(dc, d);
  link(f, bc.twin, bc.set);  // b -> c
  set_edge(cd, c);
  link(dc, cd);
  vertex_edges_[a.index()] = e;
  vertex_edges_[b.index()] = f;
  vertex_edges_[c.index()] = cd;
  vertex_edges_[d.index()] = dc;
}

/// Flips until every edge that suspects_ leads to is constrained Delaunay.
void Triangulation::restore_delaunay() {
  while (!suspects_.empty()) {
    const EdgeId e = suspects_.back();
    suspects_.pop_back();
    const EdgeId f = twin(e);
    if (is_constrained(e) || !should_flip(from(e), from(f), apex(e), apex(f))) continue;
    flip(e);
    for (const EdgeId side : {e, f, prev(e), prev(f)}) suspects_.push_back(side);
  }
}

/// Puts the edges at a vertex and those around it on the list of suspects.
void Triangulation::push_star(VertexId v) {
  const EdgeId first = edge(v);
  EdgeId e = first;
  do {
    suspects_.push_back(e);
    suspects_.push_back(next(e));
    e = rotated(e);
  } while (e != first);
}

}  // namespace loft::cdt
