// SPDX-License-Identifier: MIT
#include <algorithm>
#include <bit>
#include <cstdint>
#include <stdexcept>
#include <utility>

#include "cdt/disc.h"
#include "cdt/predicates.h"
#include "cdt/rounding.h"
#include "cdt/triangulation.h"

namespace loft::cdt {

namespace {

bool is_between(Point a, Point b, Point p) { return a < b ? a < p && p < b : b < p && p < a; }

/// Flips for each vertex, all in all, that are still a usual effort: three or four are the rule.
constexpr std::size_t usual_flips = 16;

/// Puts indices into an order that no curve can foresee, the same every time (Fisher, Yates, 1938).
void shuffle(std::span<std::size_t> indices) {
  std::uint64_t dice = 0x9e37'79b9'7f4a'7c15;
  for (std::size_t n = indices.size(); n > 1; --n) {
    dice = dice * 6364136223846793005 + 1442695040888963407;
    std::swap(indices[n - 1], indices[(dice >> 33) % n]);
  }
}

}  // namespace

/// Coarse to fine: every 2^k-th point, then those half way between, each located from its
/// neighbour. Along a curve, in the order of the curve, most flips would be undone by later ones.
/// Where that does not help, as in a star whose tips are all inserted before what is between them,
/// the rest of each pass is inserted in random order: expected O(n log n) flips, whatever the
/// curve.
void Triangulation::insert_points(std::span<const Point> points) {
  const std::size_t n = points.size();
  inserted_.resize(n);
  if (locator_.is_outgrown(vertex_count(), points[0])) locator_.lay_out(points_, vertex_count());
  inserted_[0] = insert_near(points[0], hint_for(points[0]));
  flips_ = 0;
  for (std::size_t stride = std::bit_floor(n); stride > 0; stride /= 2) insert_pass(points, stride);
  for (const VertexId v : inserted_) ++uses_[v.index()];
}

/// The points half way between those that are `2 * stride` apart, which are there already.
void Triangulation::insert_pass(std::span<const Point> points, std::size_t stride) {
  const auto insert = [&](std::size_t i) {
    inserted_[i] = insert_near(points[i], edge(inserted_[i - stride]));
  };
  std::size_t i = stride;
  for (; i < points.size() && flips_ <= usual_flips * vertex_count(); i += 2 * stride) insert(i);
  std::vector<std::size_t> rest;
  for (; i < points.size(); i += 2 * stride) rest.push_back(i);
  shuffle(rest);
  for (const std::size_t k : rest) insert(k);
}

TriangleId Triangulation::new_triangle() {
  TriangleId t;
  if (!free_triangles_.empty()) {
    t = free_triangles_.back();
    free_triangles_.pop_back();
  } else {
    t = TriangleId(static_cast<std::uint32_t>(triangle_bound_));
    if (edge_bound() >= edges_.size()) grow();
    ++triangle_bound_;
  }
  if (is_recording_) note(Touch(t, false, false));
  return t;
}

/// Each triangle once: what counts is how it was touched first, and whether it only moved since.
void Triangulation::note(Touch touch) {
  const std::uint32_t t = touch.triangle().index();
  if (t >= touched_at_.size()) touched_at_.resize(edges_.size() / 3);
  std::uint32_t& at = touched_at_[t];
  if (at >= touched_.size() || touched_[at].triangle() != touch.triangle()) {
    at = static_cast<std::uint32_t>(touched_.size());
    touched_.push_back(touch);
  } else if (!touch.has_only_moved()) {
    touched_[at].change();
  }
}

/// Room for more triangles: a little at a time, so that no memory is touched in vain.
void Triangulation::grow() {
  constexpr std::size_t more = 3 * 256;
  if (edges_.size() + more > OrientedEdge::constrained)
    throw std::length_error("a triangulation has at most 2^31 edges");
  edges_.resize(edges_.size() + more);
}

void Triangulation::grow_sets() { edge_sets_.resize(edges_.size()); }

void Triangulation::free_triangle(TriangleId t) {
  touch(t);
  for (unsigned i = 0; i < 3; ++i) edges_[3 * t.index() + i] = {VertexId::none(), 0};
  free_triangles_.push_back(t);
}

VertexId Triangulation::new_vertex(Point point) {
  ++vertex_count_;
  if (!reserved_.is_none()) {
    const VertexId v = std::exchange(reserved_, VertexId::none());
    uses_[v.index()] = 0;
    return v;
  }
  if (!free_vertices_.empty()) {
    const VertexId v = free_vertices_.back();
    free_vertices_.pop_back();
    points_[v.index()] = point;
    uses_[v.index()] = 0;
    return v;
  }
  const VertexId v(static_cast<std::uint32_t>(points_.size()));
  points_.push_back(point);
  vertex_edges_.emplace_back();
  uses_.push_back(0);
  return v;
}

void Triangulation::free_vertex(VertexId v) {
  --vertex_count_;
  points_[v.index()] = point(infinite);
  vertex_edges_[v.index()] = EdgeId::none();
  uses_[v.index()] = unused;
  if (v.index() < traits_.size()) traits_[v.index()] = 0;
  free_vertices_.push_back(v);
}

void Triangulation::join(EdgeId a, EdgeId b, PassageSet set) {
  if (set.is_empty()) {
    join(a, b);
    return;
  }
  edges_[a.index()].bits = b.index() | OrientedEdge::constrained;
  edges_[b.index()].bits = a.index() | OrientedEdge::constrained;
  set_at(a) = set;
  set_at(b) = set;
}

VertexId Triangulation::insert_near(Point point, EdgeId hint) {
  Location place = locate(point, hint);
  if (place.kind == Location::Kind::vertex) {
    last_ = place.edge;
    const VertexId v = from(place.edge);
    has_bends_ |= uses_[v.index()] == 0;  // it was a crossing
    return v;
  }
  if (place.kind == Location::Kind::nowhere) {
    if (vertex_count() == 1 && distance(this->point(only_), point) <= epsilon_) return only_;
    const VertexId v = new_vertex(point);
    if (vertex_count() == 1) {
      only_ = v;
      return v;
    }
    start(only_, v);
    note_crowd(v);
    last_ = edge(v);
    return v;
  }
  if (epsilon_ > 0) {
    if (const VertexId v = merge(place, point); !v.is_none()) return v;
  } else {
    if (place.kind == Location::Kind::triangle && has_constrained_side(triangle(place.edge)))
      if (const EdgeId e = led_through(place.edge, point); !e.is_none())
        place = {Location::Kind::edge, e};
    if (place.kind == Location::Kind::edge && is_constrained(place.edge))
      doubt_others_on(place.edge, point);
  }
  const VertexId v = split_at(place, point);
  if (epsilon_ == 0) settle_new(v);
  last_ = edge(v);
  locator_.add(v, point);
  return v;
}

/// With an epsilon: the nearest vertex that close to a point in no vertex; if there is none,
/// `place` becomes the nearest constrained edge that close, where that can be split there.
VertexId Triangulation::merge(Location& place, Point p) const {
  VertexId vertex;
  EdgeId constrained;
  double to_vertex = epsilon_;
  double to_edge = epsilon_;
  visit_disc(
      *this, place, p, [&] { return epsilon_; },
      [&](TriangleId t) {
        for (unsigned corner = 0; corner < 3; ++corner) {
          const EdgeId e = edge(t, corner);
          if (from(e) == infinite) continue;
          if (const double d = distance(point(from(e)), p); d <= to_vertex) {
            vertex = from(e);
            to_vertex = d;
          }
          if (!is_constrained(e)) continue;
          if (const double d = distance_to_segment(point(from(e)), point(to(e)), p); d <= to_edge) {
            constrained = e;
            to_edge = d;
          }
        }
      });
  if (vertex.is_none() && !constrained.is_none() && can_split(constrained, p))
    place = {Location::Kind::edge, constrained};
  return vertex;
}

/// A new vertex in a triangle, on an edge or outside.
VertexId Triangulation::split_at(Location place, Point point) {
  if (place.kind == Location::Kind::edge) return split_edge_at(place.edge, point);
  const VertexId v = new_vertex(point);
  if (place.kind == Location::Kind::outside && to(place.edge) == infinite) {
    extend(place.edge, v);
  } else {
    if (place.kind == Location::Kind::outside) is_flat_ = false;
    split_triangle(triangle(place.edge), v);
  }
  return v;
}

/// The side of the triangle left of an edge that has segments along it which all lead through a
/// point inside, as that is where a point of each rounds to; none if there is no such side.
EdgeId Triangulation::led_through(EdgeId inside, Point p) const {
  const auto leads = [&](Passage passage) {
    const Segment& s = segment(passage.segment());
    return rounds_to(point(s.from), point(s.to), p);
  };
  for (const EdgeId e : {inside, next(inside), prev(inside)})
    if (is_constrained(e) && is_boxed(point(from(e)), point(to(e)), p) &&
        std::ranges::all_of(passages(e), leads) && can_split(e, p))
      return e;
  return EdgeId::none();
}

/// Notes the segments along an edge that are led through a point without being there.
void Triangulation::doubt_others_on(EdgeId e, Point p) {
  for (const Passage passage : passages(e)) {
    const Segment& s = segment(passage.segment());
    if (orient(point(s.from), point(s.to), p) == 0) continue;
    has_bends_ = true;
    if (!rounds_to(point(s.from), point(s.to), p)) doubt(passage.segment(), p);
  }
}

/// An edge with an infinite triangle on each side, whose edges to and from infinity are still open.
/// Returns the edges a -> b and b -> a.
std::pair<EdgeId, EdgeId> Triangulation::add_flat_edge(VertexId a, VertexId b) {
  const EdgeId there = edge(new_triangle());
  const EdgeId back = edge(new_triangle());
  set_from(there, a);
  set_from(next(there), b);
  set_from(prev(there), infinite);
  set_from(back, b);
  set_from(next(back), a);
  set_from(prev(back), infinite);
  join(there, back);
  join(next(there), prev(back));
  vertex_edges_[b.index()] = back;
  return {there, back};
}

/// The first two vertices.
void Triangulation::start(VertexId a, VertexId b) {
  const auto [there, back] = add_flat_edge(a, b);
  join(prev(there), next(back));
  vertex_edges_[a.index()] = there;
  vertex_edges_[infinite.index()] = prev(there);
  is_flat_ = true;
  is_crowded_ = true;  // for all that is known
}

/// While all vertices are in one line: one more beyond the end that `end` leaves to infinity.
void Triangulation::extend(EdgeId end, VertexId v) {
  const EdgeId end_back = twin(end);
  const auto [there, back] = add_flat_edge(from(end), v);
  touch(triangle(end));
  touch(triangle(end_back));
  join(prev(there), end);
  join(next(back), end_back);
  is_crowded_ = true;  // for all that is known
}

/// Every triangle that a split makes has the new vertex at corner 2, and the edge that may need a
/// flip at corner 0.
void Triangulation::split_triangle(TriangleId t, VertexId v) {
  touch(t);
  const EdgeId old[3] = {edge(t, 0), edge(t, 1), edge(t, 2)};
  const VertexId starts[3] = {from(old[0]), from(old[1]), from(old[2])};
  const Side sides[3] = {side(old[0]), side(old[1]), side(old[2])};
  const TriangleId parts[3] = {t, new_triangle(), new_triangle()};
  for (unsigned i = 0; i < 3; ++i) {
    set_from(edge(parts[i], 0), starts[i]);
    set_from(edge(parts[i], 1), starts[(i + 1) % 3]);
    set_from(edge(parts[i], 2), v);
    attach(edge(parts[i], 0), sides[i]);
    vertex_edges_[starts[i].index()] = edge(parts[i], 0);
  }
  for (unsigned i = 0; i < 3; ++i) join(edge(parts[i], 1), edge(parts[(i + 1) % 3], 2));
  vertex_edges_[v.index()] = edge(t, 2);
  fan_out(v);
}

void Triangulation::split_edge(EdgeId e, VertexId v) {
  const EdgeId f = twin(e);
  const VertexId a = from(e);
  const VertexId b = from(f);
  const VertexId c = apex(e);
  const VertexId d = apex(f);
  touch(triangle(e));
  touch(triangle(f));
  const EdgeId old[4] = {prev(e), next(e), prev(f), next(f)};
  Side sides[4] = {side(old[0]), side(old[1]), side(old[2]), side(old[3])};
  const PassageSet set = side(e).set;
  const bool was_upward = !set.is_empty() && is_upward(e);
  if (!set.is_empty()) note(passed, v);

  // Around v, clockwise: (c, a, v), (b, c, v), (d, b, v), (a, d, v).
  const VertexId starts[4] = {c, b, d, a};
  const VertexId ends[4] = {a, c, b, d};
  const TriangleId parts[4] = {triangle(e), new_triangle(), triangle(f), new_triangle()};
  if (is_flat_) {
    // At the end of a line of vertices the two infinite triangles are neighbours twice.
    for (Side& beyond : sides)
      if (const auto* edge_here = std::ranges::find(old, EdgeId(beyond.bits));
          edge_here != std::end(old))
        beyond.bits = edge(parts[edge_here - old], 0).index();
  }
  for (unsigned i = 0; i < 4; ++i) {
    const EdgeId outer = edge(parts[i], 0);
    set_from(outer, starts[i]);
    set_from(edge(parts[i], 1), ends[i]);
    set_from(edge(parts[i], 2), v);
    attach(outer, sides[i]);
    vertex_edges_[starts[i].index()] = outer;
  }
  // A rounded point may lie beyond the ends in the lexicographic order: turn the passages then.
  const auto half = [&](VertexId low, VertexId high, PassageSet passages) {
    const bool upward = !set.is_empty() && point(low) < point(high);
    return upward == was_upward ? passages : sets_.reversed(passages);
  };
  join(edge(parts[0], 2), edge(parts[1], 1));                               // v-c
  join(edge(parts[1], 2), edge(parts[2], 1), half(v, b, sets_.copy(set)));  // v-b
  join(edge(parts[2], 2), edge(parts[3], 1));                               // v-d
  join(edge(parts[3], 2), edge(parts[0], 1), half(a, v, set));              // v-a
  vertex_edges_[v.index()] = edge(parts[0], 2);
  fan_out(v);
}

/// Whether the edge ab between the triangles (a, b, c) and (b, a, d) is not Delaunay. An infinite
/// corner stands for a point so far away that circles through it are straight lines.
inline bool Triangulation::should_flip(VertexId a, VertexId b, VertexId c, VertexId d) const {
  if (c == infinite || d == infinite) return false;
  if (a == infinite) return orient(point(d), point(b), point(c)) > 0;
  if (b == infinite) return orient(point(c), point(a), point(d)) > 0;
  return in_circle_perturbed(point(a), point(b), point(c), point(d)) > 0;
}

/// Flips the edges opposite to the new vertex v until they are Delaunay (Lawson): once around it,
/// staying where an edge was flipped, as another is there then. In every triangle the edge is at
/// corner 0, v at corner 2; flips keep it so. Its neighbours are looked at from v, each once.
void Triangulation::fan_out(VertexId v) {
  using detail::Sight;
  const Point place = point(v);
  const double near = crowded_rounding * std::max(std::abs(place.x), std::abs(place.y));
  TriangleId t = triangle(edge(v));
  const VertexId first = from(edge(t, 0));
  VertexId b = from(edge(t, 1));
  Sight to_a(place, point(first));
  Sight to_b(place, point(b));
  is_surrounded_ = false;
  is_crowded_ = false;
  for (VertexId a = first;;) {
    const EdgeId e = edge(t, 0);
    if (is_constrained(e)) {
      is_surrounded_ |= to_a.x * to_b.x <= 0 && to_a.y * to_b.y <= 0;  // as is_boxed()
    } else {
      const VertexId d = apex(twin(e));
      const Sight to_d(place, point(d));
      const int side = detail::in_circle_filter(to_b, to_a, to_d);  // the same as of a, b, v and d
      if (side > 0 || (side == 0 && should_flip(a, b, v, d))) {
        flip_away(e, v, d);
        b = d;
        to_b = to_d;
        continue;
      }
    }
    if (!is_clear_of_crowds(to_a, to_b, near)) is_crowded_ |= is_crowded_by(e, place);
    if (b == first) break;
    t = triangle(twin(edge(t, 1)));
    a = b;
    to_a = to_b;
    b = from(edge(t, 1));
    to_b = Sight(place, point(b));
  }
}

/// Whether a new vertex opposite to e is so near to it that others may be hardly beside. Without
/// segments only vertices matter.
bool Triangulation::is_crowded_by(EdgeId e, Point place) const {
  const Point a = point(from(e));
  if (segments_.empty() || from(e) == infinite || to(e) == infinite)
    return are_hardly_apart(place, a, crowded_rounding);
  return is_crowding(a, point(to(e)), place);
}

/// Turns the edge e between the triangles (a, b, v) and (b, a, d) so that it joins v and d.
void Triangulation::flip_away(EdgeId e, VertexId v, VertexId d) {
  const EdgeId f = twin(e);
  const VertexId a = from(e);
  const VertexId b = from(f);
  const Side ad = side(next(f));
  const Side db = side(prev(f));
  const Side bv = side(next(e));
  const TriangleId t = triangle(e);
  const TriangleId u = triangle(f);
  touch(t);
  touch(u);
  set_from(edge(t, 1), d);
  attach(edge(t, 0), ad);
  set_from(edge(u, 0), d);
  set_from(edge(u, 1), b);
  set_from(edge(u, 2), v);
  attach(edge(u, 0), db);
  attach(edge(u, 1), bv);
  join(edge(t, 1), edge(u, 2));
  ++flips_;
  vertex_edges_[a.index()] = edge(t, 0);
  vertex_edges_[b.index()] = edge(u, 1);
  vertex_edges_[d.index()] = edge(u, 0);
}

/// Whether a place is clearly in the circles of both triangles beside e.
bool Triangulation::is_in_both_circles(EdgeId e, Point place) const {
  using detail::Sight;
  const Sight to_a(place, point(from(e)));
  const Sight to_b(place, point(to(e)));
  const Sight to_c(place, point(apex(e)));
  const Sight to_d(place, point(apex(twin(e))));
  return detail::in_circle_filter(to_a, to_b, to_c) > 0 &&
         detail::in_circle_filter(to_b, to_a, to_d) > 0;
}

/// A new vertex on an edge, or so near that it bends it. In the circles of both triangles there it
/// is joined to its neighbours by edges that are Delaunay, as any point in a triangle is (Lawson):
/// each of them has a circle inside that of a triangle which made way. If only rounding has put it
/// beside the edge, it is in both but for the flattest ones.
VertexId Triangulation::split_edge_at(EdgeId e, Point place) {
  const bool is_bent =
      !is_in_both_circles(e, place) && orient(point(from(e)), point(to(e)), place) != 0;
  const VertexId v = new_vertex(place);
  split_edge(e, v);
  if (is_bent) {
    is_flat_ = false;
    push_star(v);
    // What fan_out() has seen holds for as long as nothing around has changed.
    if (restore_delaunay()) is_surrounded_ = is_crowded_ = true;
  }
  return v;
}

bool Triangulation::can_split(EdgeId e, Point p) const {
  if (from(e) == infinite || to(e) == infinite) return false;
  // On the left of the way from a to b by the corner between them?
  const auto is_within = [&](Point a, Point b, VertexId corner) {
    if (corner != infinite)
      return orient(a, point(corner), p) > 0 && orient(point(corner), b, p) > 0;
    // Nothing stands in the way beyond the hull, but the point is to be beside the edge.
    if (!is_alongside(a, b, p) || p == a || p == b) return false;
    return orient(a, b, p) != 0 || is_between(a, b, p);
  };
  const Point a = point(from(e));
  const Point b = point(to(e));
  return is_within(b, a, apex(e)) && is_within(a, b, apex(twin(e)));
}

/// Turns the diagonal of the two triangles beside e, which must make a convex quadrilateral.
void Triangulation::flip(EdgeId e) {
  const EdgeId f = twin(e);
  const VertexId a = from(e);
  const VertexId b = from(f);
  const VertexId c = apex(e);
  const VertexId d = apex(f);
  const Side bc = side(next(e));
  const Side ad = side(next(f));
  const EdgeId dc = next(e);
  const EdgeId cd = next(f);
  touch(triangle(e));
  touch(triangle(f));
  attach(e, ad);  // a -> d
  set_from(dc, d);
  attach(f, bc);  // b -> c
  set_from(cd, c);
  join(dc, cd);
  vertex_edges_[a.index()] = e;
  vertex_edges_[b.index()] = f;
  vertex_edges_[c.index()] = cd;
  vertex_edges_[d.index()] = dc;
}

/// Flips until every edge that suspects_ leads to is constrained Delaunay. Returns whether there
/// was one to flip.
bool Triangulation::restore_delaunay() {
  bool has_flipped = false;
  while (!suspects_.empty()) {
    const EdgeId e = suspects_.back();
    suspects_.pop_back();
    if (is_constrained(e)) continue;
    const EdgeId f = twin(e);
    if (!should_flip(from(e), from(f), apex(e), apex(f))) continue;
    flip(e);
    has_flipped = true;
    for (const EdgeId side : {e, f, prev(e), prev(f)}) suspects_.push_back(side);
  }
  return has_flipped;
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
