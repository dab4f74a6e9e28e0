// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>

#include "cdt/effort.h"
#include "cdt/predicates.h"
#include "cdt/rounding.h"
#include "cdt/triangulation.h"

namespace loft::cdt {

/// KBT, insert_segment: from vertex to vertex towards the end, splitting the constrained edges in
/// the way. Crossings are rounded and so a little beside the line; which one comes next is for the
/// line as inserted to say. Wherever that is in doubt lay_through() finds its way with more effort.
void Triangulation::lay(SegmentId s) {
  const Segment segment = this->segment(s);
  if (segment.from == segment.to) return;
  if (epsilon_ > 0) {
    lay_crooked(s, segment.from);
    return;
  }
  const unsigned suspicious = has_bends_ ? passed | crowded : crowded;
  const auto misses_something = [&](VertexId v) {
    return (traits(v) & suspicious) != 0 && misses_something_at(v, s);
  };
  if (misses_something(segment.from) || misses_something(segment.to) || !lay_straight(s))
    lay_through(s);
}

/// What lay() does where nothing is in doubt. If something is, the rest is left.
bool Triangulation::lay_straight(SegmentId s) {
  const Segment segment = this->segment(s);
  if (const EdgeId e = edge_between(segment.from, segment.to); !e.is_none()) {
    mark(e, s);
    return settle_piece(e, s);
  }
  const Point a = point(segment.from);
  const Point b = point(segment.to);
  VertexId at = segment.from;
  EdgeId back;
  while (at != segment.to) {
    const Obstacle obstacle = walk(at, segment.to, a, b, back);
    const std::size_t vertices = vertex_count_;
    VertexId ahead = obstacle.vertex;
    EdgeId piece = obstacle.edge;
    switch (obstacle.kind) {
      case Obstacle::Kind::edge_along:
        ahead = to(piece);
        mark(piece, s);
        break;
      case Obstacle::Kind::constrained_edge:
        ahead = meet(piece, s);
        if (ahead.is_none() || ahead == at) return false;
        piece = connect(at, ahead, s);
        break;
      case Obstacle::Kind::vertex:
        if (at == segment.from) {
          piece = force_edge(at, ahead);
          mark(piece, s);
        } else {
          piece = connect(at, ahead, s);
        }
        break;
      case Obstacle::Kind::confusion:
        return false;
    }
    if (piece.is_none() || !is_ahead(point(at), point(ahead), a, b)) return false;
    const bool is_new = vertex_count_ > vertices;
    if (ahead != segment.to && !is_new && misses_something_at(ahead, s)) return false;
    if (!settle_piece(piece, s)) return false;
    at = ahead;
    back = twin(piece);
  }
  return true;
}

/// The vertex at which s goes through the constrained edge e: an end of it or a new one. None where
/// that is in doubt.
VertexId Triangulation::meet(EdgeId e, SegmentId s) {
  const std::optional<Point> place = common_crossing(e, s);
  if (!place) return VertexId::none();
  for (const VertexId end : {from(e), to(e)}) {
    if (point(end) != *place) continue;
    has_bends_ = true;
    return end;
  }
  // Near 0 rounding may have bent the segments along e so much that s crosses them further on.
  if (!is_boxed(point(from(e)), point(to(e)), *place) || !can_split(e, *place))
    return VertexId::none();
  const VertexId v = split_edge_at(e, *place);
  return settle_new(v) ? v : VertexId::none();
}

/// Where s crosses all segments along e, if that is one place.
std::optional<Point> Triangulation::common_crossing(EdgeId e, SegmentId s) const {
  const Point a = point(segment(s).from);
  const Point b = point(segment(s).to);
  std::optional<Point> place;
  for (const Passage passage : passages(e)) {
    const Point c = point(segment(passage.segment()).from);
    const Point d = point(segment(passage.segment()).to);
    if (!crosses(a, b, c, d)) return {};
    const Point here = intersection(a, b, c, d);
    if (place && here != *place) return {};
    place = here;
  }
  return place;
}

/// Whether s, which goes through a vertex, crosses another one that does so elsewhere, being led
/// there by rounding alone; or whether it has to go through a vertex hardly beside this one.
bool Triangulation::misses_something_at(VertexId v, SegmentId s) const {
  const bool is_end = ends_at(s, v);  // what ends there, too, does not cross s
  const bool is_crowded = (traits(v) & crowded) != 0;
  const Point place = point(v);
  const double near = crowded_rounding * std::max(std::abs(place.x), std::abs(place.y));
  const auto is_missed = [&](Point beside) {
    return std::abs(beside.x - place.x) + std::abs(beside.y - place.y) <= near &&
           rounds_to(point(segment(s).from), point(segment(s).to), beside);
  };
  const auto is_missed_along = [&](Passage passage) {
    return !(is_end && ends_at(passage.segment(), v)) &&
           crosses_elsewhere(s, passage.segment(), place);
  };
  const EdgeId first = edge(v);
  EdgeId e = first;
  do {
    if (is_crowded && is_missed(point(to(e)))) return true;
    if (is_constrained(e) && std::ranges::any_of(passages(e), is_missed_along)) return true;
    e = rotated(e);
  } while (e != first);
  return false;
}

/// Whether two segments cross, but not at this place.
bool Triangulation::crosses_elsewhere(SegmentId one, SegmentId other, Point place) const {
  const auto [a, b] = ends_of(one);
  const auto [c, d] = ends_of(other);
  return crosses(a, b, c, d) && intersection(a, b, c, d) != place;
}

/// Whether two segments cross at a place, rounded.
bool Triangulation::crosses_at(SegmentId one, SegmentId other, Point place) const {
  const auto [a, b] = ends_of(one);
  const auto [c, d] = ends_of(other);
  if (!crosses(a, b, c, d)) return false;
  const Point crossing = intersection(a, b, c, d);
  return crossing == place || (epsilon_ > 0 && distance(crossing, place) <= epsilon_);
}

/// Makes and marks the straight edge between two vertices; none if something is between them.
EdgeId Triangulation::connect(VertexId from, VertexId to, SegmentId s) {
  spend(8);
  EdgeId e = edge_between(from, to);
  if (e.is_none()) {
    const Obstacle obstacle = walk(from, to, point(from), point(to));
    if (obstacle.kind != Obstacle::Kind::vertex || obstacle.vertex != to) return EdgeId::none();
    e = force_edge(from, to);
  }
  mark(e, s);
  return e;
}

/// Adds a passage of s along e, in the direction of e.
void Triangulation::mark(EdgeId e, SegmentId s) {
  const EdgeId f = twin(e);
  touch(triangle(e));
  touch(triangle(f));
  const VertexId a = from(e);
  const VertexId b = from(f);
  join(e, f, sets_.with(side(e).set, Passage(s, point(a) < point(b))));
  const Segment& segment = this->segment(s);
  for (const VertexId v : {a, b})
    if (v != segment.from && v != segment.to) note(passed, v);
}

/// What is first in the way from one vertex to another, along the line from a to b that both are
/// on but for rounding. Fills crossed_ with the edges crossed before that, each from right to
/// left. `back`, if known: the edge along which the line has come to `from`, seen from there.
Triangulation::Obstacle Triangulation::walk(VertexId from, VertexId to, Point a, Point b,
                                            EdgeId back) {
  crossed_.clear();
  Obstacle obstacle{};
  EdgeId e = back.is_none() ? first_crossed(from, to, a, b, obstacle)
                            : first_crossed_ahead(back, to, a, b, obstacle);
  if (e.is_none()) return obstacle;
  for (;;) {
    if (is_constrained(e)) return {Obstacle::Kind::constrained_edge, e, {}};
    crossed_.push_back(e);
    const EdgeId f = twin(e);
    const VertexId ahead = apex(f);
    if (ahead == infinite || ahead == from) return {Obstacle::Kind::confusion, {}, {}};
    const int side = ahead == to ? 0 : orient(a, b, point(ahead));
    if (side == 0) return {Obstacle::Kind::vertex, EdgeId::none(), ahead};
    e = side > 0 ? next(f) : prev(f);
  }
}

/// The edge opposite to `from` that the line from a to b crosses first; none if it runs along an
/// edge, which then is the obstacle.
EdgeId Triangulation::first_crossed(VertexId from, VertexId to, Point a, Point b,
                                    Obstacle& obstacle) const {
  const EdgeId first = edge(from);
  EdgeId e = first;
  int previous = 0;  // side of the last edge's end; 0 where there was none
  EdgeId before = EdgeId::none();
  EdgeId found = EdgeId::none();
  // Once around, and the first edge again.
  for (bool is_last = false;; is_last = e == first) {
    const VertexId v = this->to(e);
    int side = 0;
    if (v == to) {
      obstacle = {Obstacle::Kind::edge_along, e, {}};
      return EdgeId::none();
    }
    if (v != infinite) {
      side = orient(a, b, point(v));
      if (side == 0 && is_ahead(point(from), point(v), a, b)) {
        obstacle = {Obstacle::Kind::edge_along, e, {}};
        return EdgeId::none();
      }
    }
    if (previous < 0 && side > 0 && found.is_none()) found = next(before);
    if (is_last) break;
    previous = side;
    before = e;
    e = rotated(e);
  }
  // None: rounding has put `from` beside the line and beyond all others.
  if (found.is_none()) obstacle = {Obstacle::Kind::confusion, EdgeId::none(), {}};
  return found;
}

/// The same, where `back` tells what is behind: on the right of that the vertices are on the right
/// of the line, up to what is ahead. Where they are not, all around is looked at.
EdgeId Triangulation::first_crossed_ahead(EdgeId back, VertexId to, Point a, Point b,
                                          Obstacle& obstacle) const {
  const VertexId from = this->from(back);
  for (EdgeId e = rotated(back), before; e != back; before = e, e = rotated(e)) {
    const VertexId v = this->to(e);
    if (v == infinite) break;
    const int side = v == to ? 0 : orient(a, b, point(v));
    if (side < 0) continue;
    if (side > 0 && !before.is_none()) return next(before);
    if (side > 0 || !(v == to || is_ahead(point(from), point(v), a, b))) break;
    obstacle = {Obstacle::Kind::edge_along, e, {}};
    return EdgeId::none();
  }
  return first_crossed(from, to, a, b, obstacle);
}

// --- With an epsilon ---

/// To each vertex on the way straight from the one before, wherever that is, and to vertices
/// nearby. A split point is off the straight line by its rounding, so each becomes a goal of its
/// own that is walked to anew. Each step must lead on along the segment, but for a few.
void Triangulation::lay_crooked(SegmentId s, VertexId at) {
  const Segment segment = this->segment(s);
  goals_.assign(1, segment.to);
  int detours = 0;
  while (!goals_.empty()) {
    const VertexId goal = goals_.back();
    if (goal == at) {
      goals_.pop_back();
      continue;
    }
    if (detours > most_detours) {
      doubt(s, point(at));
      follow_corridor(at, segment.to, s);
      for (const VertexId v : goals_) loosen(v);  // made for this segment, perhaps in vain
      return;
    }
    const Obstacle obstacle = walk(at, goal, point(at), point(goal));
    const VertexId nearby = nearby_before(goal, at, s, obstacle);
    if (!nearby.is_none()) {
      goals_.push_back(nearby);
      continue;
    }
    const double before = along(s, at);
    switch (obstacle.kind) {
      case Obstacle::Kind::edge_along:
        mark(obstacle.edge, s);
        at = to(obstacle.edge);
        break;
      case Obstacle::Kind::constrained_edge: {
        const std::size_t doubts = snaps_.size();
        const VertexId crossing = cross(obstacle.edge, s);
        const bool leads_on = crossing != at && along(s, crossing) > before;
        if (snaps_.size() > doubts || !leads_on) ++detours;
        goals_.push_back(crossing);
        break;
      }
      case Obstacle::Kind::vertex:
        mark(force_edge(at, obstacle.vertex), s);
        at = obstacle.vertex;
        break;
      case Obstacle::Kind::confusion:  // cannot be: this line goes through `at`
        follow_corridor(at, segment.to, s);
        return;
    }
    if (obstacle.kind != Obstacle::Kind::constrained_edge && along(s, at) <= before) ++detours;
  }
}

/// How far along a segment a vertex is, in no particular unit.
double Triangulation::along(SegmentId s, VertexId v) const {
  const Point a = point(segment(s).from);
  const Point b = point(segment(s).to);
  return (point(v).x - a.x) * (b.x - a.x) + (point(v).y - a.y) * (b.y - a.y);
}

/// Makes a vertex where segment s crosses the constrained edge e, or finds the vertex to go
/// through instead.
VertexId Triangulation::cross(EdgeId e, SegmentId s) {
  const std::optional<Point> place = crossing_point(e, s);
  if (!place) return snap(e, nearest_on(e, s), s);
  for (const VertexId end : {from(e), to(e)})
    if (distance(point(end), *place) <= epsilon_) return end;
  if (!can_split(e, *place)) return snap(e, *place, s);
  return split_edge_at(e, *place);
}

/// About where a segment comes nearest to an edge that rounding alone made it cross.
Point Triangulation::nearest_on(EdgeId e, SegmentId s) const {
  const auto [a, b] = ends_of(s);
  const Point p = point(from(e));
  const Point q = point(to(e));
  const double at_p = distance_to_line(a, b, p);
  const double at_q = distance_to_line(a, b, q);
  const double share = at_p + at_q > 0 ? at_p / (at_p + at_q) : 0.5;
  return {p.x + share * (q.x - p.x), p.y + share * (q.y - p.y)};
}

/// Where s crosses the segment that e is a piece of. Of several such segments that the
/// coordinates put first decides. None if rounding alone made s and e cross.
std::optional<Point> Triangulation::crossing_point(EdgeId e, SegmentId s) const {
  const auto [a, b] = ends_of(s);
  std::optional<std::pair<Point, Point>> best;
  for (const Passage passage : passages(e)) {
    const std::pair<Point, Point> other = ends_of(passage.segment());
    if (crosses(a, b, other.first, other.second) && (!best || other < *best)) best = other;
  }
  if (!best) return {};
  return intersection(a, b, best->first, best->second);
}

/// The ends of a segment in the order of their coordinates.
std::pair<Point, Point> Triangulation::ends_of(SegmentId s) const {
  const Point a = point(segment(s).from);
  const Point b = point(segment(s).to);
  if (b < a) return {b, a};
  return {a, b};
}

/// The vertex of the two triangles beside e that is nearest to a place; e is led through it.
VertexId Triangulation::snap(EdgeId e, Point place, SegmentId s) {
  doubt(s, place);
  for (const Passage passage : passages(e)) doubt(passage.segment(), place);
  VertexId nearest = from(e);
  for (const VertexId v : {to(e), apex(e), apex(twin(e))})
    if (v != infinite && distance(point(v), place) < distance(point(nearest), place)) nearest = v;
  if (nearest != from(e) && nearest != to(e)) reroute(e, nearest);
  return nearest;
}

/// Moves the passages of e to the two edges that join its ends through an apex beside it.
void Triangulation::reroute(EdgeId e, VertexId through) {
  note(passed, through);
  if (apex(e) != through) e = twin(e);
  const bool was_upward = is_upward(e);
  const PassageSet rerouted = side(e).set;
  around_passages_.assign(passages(e).begin(), passages(e).end());
  sets_.release(rerouted);
  for (const EdgeId side : {twin(prev(e)), twin(next(e))}) {  // from(e) -> apex -> to(e)
    PassageSet set = this->side(side).set;
    for (const Passage passage : around_passages_)
      set = sets_.with(set, is_upward(side) == was_upward ? passage : passage.reversed());
    join(side, twin(side), set);
    touch(triangle(side));
    touch(triangle(twin(side)));
  }
  join(e, twin(e));
  touch(triangle(e));
  touch(triangle(twin(e)));
  suspects_.push_back(e);
  restore_delaunay();
}

/// The last resort: marks the existing edges left of the straight line. Always possible, but where
/// numbers are so tiny, in what was loaded, that exact arithmetic underflows.
void Triangulation::follow_corridor(VertexId at, VertexId goal, SegmentId s) {
  std::size_t steps = 0;
  while (at != goal) {
    Obstacle obstacle{};
    EdgeId e = first_crossed(at, goal, point(at), point(goal), obstacle);
    if (e.is_none()) {
      if (obstacle.kind != Obstacle::Kind::edge_along || ++steps > edge_bound()) return;
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
      if (ahead == infinite || ++steps > edge_bound()) return;
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

/// With an epsilon: the first vertex that the straight way to a goal passes closer than that, if it
/// is further along the segment than `at` and not as far as the goal; else none. It is one of those
/// that the way comes by before the obstacle.
VertexId Triangulation::nearby_before(VertexId goal, VertexId at, SegmentId s,
                                      const Obstacle& obstacle) const {
  VertexId nearest;
  double shortest = along(s, goal);
  const double start = along(s, at);
  const auto consider = [&](VertexId v) {
    if (v == infinite || v == at || v == goal || v == obstacle.vertex) return;
    const double here = along(s, v);
    if (here <= start || here >= shortest) return;
    if (distance_to_segment(point(at), point(goal), point(v)) > epsilon_) return;
    nearest = v;
    shortest = here;
  };
  for (const EdgeId e : crossed_) {
    consider(from(e));
    consider(to(e));
  }
  if (obstacle.kind == Obstacle::Kind::constrained_edge) {
    consider(from(obstacle.edge));
    consider(to(obstacle.edge));
  } else if (obstacle.kind == Obstacle::Kind::edge_along) {
    const VertexId ahead = to(obstacle.edge);
    for (const VertexId v : {apex(obstacle.edge), apex(twin(obstacle.edge))})
      if (along(s, v) < along(s, ahead)) consider(v);
  }
  return nearest;
}

}  // namespace loft::cdt
