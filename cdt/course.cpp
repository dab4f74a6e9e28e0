// SPDX-License-Identifier: MIT
// Which vertices a segment leads through: those that one of its points rounds to. This is snap
// rounding (Hobby, "Practical Segment Intersection with Finite Precision Output", 1999; Guibas and
// Marimont, "Rounding Arrangements Dynamically", 1998), on the doubles in the place of a grid.
#include <algorithm>
#include <cmath>
#include <optional>

#include "cdt/each_once.h"
#include "cdt/predicates.h"
#include "cdt/rounding.h"
#include "cdt/triangulation.h"

namespace loft::cdt {

/// Whether a passage of the edge e has to lead through the apex of e instead: because a point of
/// its segment rounds to that, or because e, being led through other such vertices, is on the wrong
/// side of it. (On a grid the latter could not be; doubles are closer to each other near 0.)
bool Triangulation::belongs_at_apex(EdgeId e, Passage passage) {
  const Segment& segment = this->segment(passage.segment());
  const Point a = point(segment.from);
  const Point b = point(segment.to);
  const Point p = point(apex(e));
  const bool is_forward = this->is_forward(e, passage);
  const VertexId before = is_forward ? from(e) : to(e);
  const VertexId after = is_forward ? to(e) : from(e);
  if (!is_ahead(point(before), p, a, b) || !is_ahead(p, point(after), a, b)) return false;
  if (rounds_to(a, b, p)) return true;
  if (before == segment.from && after == segment.to) return false;
  if (orient(a, b, p) == (is_forward ? 1 : -1)) return false;
  doubt(passage.segment(), p);
  return true;
}

/// Moves the passages of e that belong there to the edges from its ends to its apex.
bool Triangulation::lead_through_apex(EdgeId e) {
  const VertexId through = apex(e);
  if (through == infinite || !is_boxed(point(from(e)), point(to(e)), point(through))) return false;
  // Mostly there is none that does.
  const auto belongs = [&](Passage passage) { return belongs_at_apex(e, passage); };
  if (std::ranges::none_of(passages(e), belongs)) return false;
  around_passages_.assign(passages(e).begin(), passages(e).end());
  for (const Passage passage : around_passages_) {
    if (!belongs(passage)) continue;
    const bool is_forward = this->is_forward(e, passage);
    unmark(e, passage);
    mark(is_forward ? twin(prev(e)) : prev(e), passage.segment());
    mark(is_forward ? twin(next(e)) : next(e), passage.segment());
  }
  unsettled_.emplace_back(from(e), through);
  unsettled_.emplace_back(through, to(e));
  has_bends_ = true;
  restore_delaunay();
  return true;
}

/// Calls visit(edge) for the edges around v, and goes on around vertices that are near and beyond
/// edges that are.
template <class IsNearVertex, class IsNearEdge, class Visit>
void Triangulation::visit_near(VertexId v, IsNearVertex is_near_vertex, IsNearEdge is_near_edge,
                               Visit visit) {
  crowd_.assign(1, v);
  is_in_crowd_.resize(points_.size());
  is_in_crowd_[v.index()] = true;
  const auto add = [&](VertexId w) {
    if (w == infinite || is_in_crowd_[w.index()]) return;
    is_in_crowd_[w.index()] = true;
    crowd_.push_back(w);
  };
  for (std::size_t i = 0; i < crowd_.size(); ++i) {
    const EdgeId first = edge(crowd_[i]);
    EdgeId e = first;
    do {
      visit(e);
      visit(next(e));
      if (to(e) != infinite && is_near_vertex(to(e))) add(to(e));
      if (from(next(e)) != infinite && to(next(e)) != infinite && is_near_edge(next(e)))
        add(apex(twin(next(e))));
      e = rotated(e);
    } while (e != first);
  }
  for (const VertexId w : crowd_) is_in_crowd_[w.index()] = false;
}

/// Leads through a vertex that is new what belongs there. Returns whether there was nothing, nor
/// anything hardly beside it: if so, segments may have to be laid anew at the end of the edit.
bool Triangulation::settle_around(VertexId v, bool may_be_crowded) {
  if (lead_others_through(v)) {
    settle_around(v);
    return false;
  }
  const bool is_crowded = may_be_crowded && find_crowds(v);
  settle_pieces();
  if (is_crowded) settle_crowd(v);
  return !is_crowded;
}

/// Leads through a vertex the first of the edges around it that has something which belongs there.
bool Triangulation::lead_others_through(VertexId v) {
  const Point place = point(v);
  const EdgeId first = edge(v);
  EdgeId e = first;
  do {
    const EdgeId around = next(e);
    if (is_constrained(around) && is_boxed(point(from(around)), point(to(around)), place) &&
        lead_through_apex(around))
      return true;
    e = rotated(e);
  } while (e != first);
  return false;
}

/// Whether a vertex that is new is hardly beside something. If it is hardly apart from others, that
/// is noted.
bool Triangulation::find_crowds(VertexId v) {
  const Point place = point(v);
  const double near = crowded_rounding * std::max(std::abs(place.x), std::abs(place.y));
  bool is_crowded = false;
  bool is_between = false;
  const EdgeId first = edge(v);
  EdgeId e = first;
  Spoke spoke(place, point(to(e)));
  do {
    const Point a = point(to(e));
    const Point b = point(apex(e));
    const Spoke following(place, b);
    if (!is_clear_of_crowds(spoke, following, near)) {
      const bool is_apart = !are_hardly_apart(place, a, crowded_rounding);
      const bool is_finite = to(e) != infinite && apex(e) != infinite;
      if (!is_apart || (is_finite && is_crowding(a, b, place))) {
        is_crowded = true;
        is_between = is_between || !is_apart || is_crowding_between(a, b, place);
      }
    }
    spoke = following;
    e = rotated(e);
  } while (e != first);
  if (is_between) note_crowd(v);
  return is_crowded;
}

/// Notes which vertices are hardly apart from a new one. The straight way to each of them crosses
/// nothing but edges that are as near.
void Triangulation::note_crowd(VertexId v) {
  const Point place = point(v);
  visit_near(
      v, [](VertexId) { return false; },
      [&](EdgeId e) {
        const Point a = point(from(e));
        const Point b = point(to(e));
        return is_crowding(a, b, place) && is_crowding_between(a, b, place);
      },
      [&](EdgeId e) {
        const VertexId w = to(e);
        if (w == v || w == infinite || !are_hardly_apart(place, point(w), 2 * crowded_rounding))
          return;
        note(crowded, v);
        note(crowded, w);
      });
}

/// Notes the segments along edges hardly beside a vertex that have to lead through it.
void Triangulation::settle_crowd(VertexId v) {
  gather_segments(v);
  const std::vector<SegmentId> here = around_;
  const Point place = point(v);
  visit_near(
      v, [&](VertexId w) { return are_hardly_apart(place, point(w)); },
      [&](EdgeId e) { return is_hardly_beside(point(from(e)), point(to(e)), place, 2); },
      [&](EdgeId e) {
        for (const Passage passage : passages(e)) {
          const SegmentId s = passage.segment();
          const auto [a, b] = ends_of(s);
          if (!std::ranges::binary_search(here, s) && !ends_at(s, v) && rounds_to(a, b, place))
            crowded_.push_back(s);
        }
      });
}

/// Lays those anew; not one after the other, as each is in the way of the next until it leads
/// through all that it has to. One round is enough but where rounding leaves no answer.
void Triangulation::lay_crowded() {
  constexpr int most_rounds = 4;
  for (int round = 1; round <= most_rounds && !crowded_.empty(); ++round) {
    take_off_crowded();
    std::vector<SegmentId> all;
    std::swap(all, crowded_);
    for (const SegmentId s : all) lay_through(s, round < most_rounds);
  }
  for (const SegmentId s : crowded_)
    if (is_segment(s)) doubt(s, point(segment(s).from));
  crowded_.clear();
}

void Triangulation::take_off_crowded() {
  keep_each_once(crowded_);
  std::erase_if(crowded_, [&](SegmentId s) { return !is_segment(s); });
  for (const SegmentId s : crowded_) take_off_to_lay_again(s);
  restore_delaunay();
}

/// Leads a new piece of s through the vertices beside it where it belongs. Returns whether there
/// was nothing, nor may be behind edges that leave its ends almost along it.
bool Triangulation::settle_piece(EdgeId e, SegmentId s) {
  const Point a = point(segment(s).from);
  const Point b = point(segment(s).to);
  const EdgeId f = twin(e);
  const Point start = point(from(e));
  const Point end = point(from(f));
  const Strip strip(start, end, a.x * a.x + a.y * a.y + b.x * b.x + b.y * b.y);
  const auto is_clear = [&](VertexId v) {
    return strip.is_far_from(point(v)) || v == infinite ||
           is_clearly_beside(
               start, end, point(v),
               std::max({std::abs(a.x), std::abs(a.y), std::abs(b.x), std::abs(b.y)}));
  };
  if (is_clear(apex(e)) && is_clear(apex(f))) return true;
  if (lead_through_apex(e) || lead_through_apex(twin(e))) {
    settle_pieces();
    return false;
  }
  return !hides_something(e);
}

/// Whether a segment along e has to lead through a neighbour of one of its ends.
bool Triangulation::hides_something(EdgeId e) const {
  const auto is_between = [&](VertexId v, SegmentId s) {
    const auto [a, b] = ends_of(s);
    const bool is_upward = point(from(e)) < point(to(e));
    const Point low = point(is_upward ? from(e) : to(e));
    const Point high = point(is_upward ? to(e) : from(e));
    return is_ahead(low, point(v), a, b) && is_ahead(point(v), high, a, b) &&
           rounds_to(a, b, point(v));
  };
  const Point start = point(from(e));
  const Point goal = point(to(e));
  for (const VertexId end : {from(e), to(e)}) {
    const EdgeId first = edge(end);
    EdgeId spoke = first;
    do {
      const VertexId v = to(spoke);
      if (v != infinite && v != from(e) && v != to(e) && is_boxed(start, goal, point(v)))
        for (const Passage passage : passages(e))
          if (is_between(v, passage.segment())) return true;
      spoke = rotated(spoke);
    } while (spoke != first);
  }
  return false;
}

void Triangulation::settle_pieces() {
  while (!unsettled_.empty()) {
    const auto [a, b] = unsettled_.back();
    unsettled_.pop_back();
    const EdgeId e = edge_between(a, b);
    if (e.is_none() || !is_constrained(e)) continue;
    if (lead_through_apex(e) || lead_through_apex(twin(e))) unsettled_.emplace_back(a, b);
  }
}

/// Lays a segment anew whatever is in its way: first all its crossings become vertices, which leads
/// the others through them; then it connects the vertices that it leads through itself. Those that
/// are to be laid anew make way if they can wait.
void Triangulation::lay_through(SegmentId s, bool can_others_wait) {
  const VertexId start = segment(s).from;
  has_bends_ = true;
  take_off_to_lay_again(s);
  restore_delaunay();
  make_crossings(s);
  if (can_others_wait && !crowded_.empty()) take_off_crowded();
  gather_stops(s);
  VertexId at = start;
  for (const VertexId stop : stops_) {
    lay_between(at, stop, s);
    at = stop;
  }
  settle_pieces();
}

/// Calls visit(edge) for the edges that the straight line of s crosses, and visit(edge) for those
/// from the vertices that it goes through.
template <class Visit>
void Triangulation::trace(SegmentId s, Visit visit) const {
  const Segment segment = this->segment(s);
  const Point a = point(segment.from);
  const Point b = point(segment.to);
  const auto visit_star = [&](VertexId v) {
    const EdgeId first = edge(v);
    EdgeId e = first;
    do {
      visit(e);
      e = rotated(e);
    } while (e != first);
  };
  std::size_t steps = 0;  // where exact arithmetic has underflowed there may be no end
  VertexId at = segment.from;
  while (at != segment.to && ++steps <= edge_bound()) {
    visit_star(at);
    Obstacle obstacle{};
    EdgeId e = first_crossed(at, segment.to, a, b, obstacle);
    if (e.is_none()) {
      if (obstacle.kind != Obstacle::Kind::edge_along) return;
      at = to(obstacle.edge);
      continue;
    }
    for (;;) {
      visit(e);
      const EdgeId f = twin(e);
      const VertexId ahead = apex(f);
      if (ahead == infinite || ++steps > edge_bound()) return;
      const int side = ahead == segment.to ? 0 : orient(a, b, point(ahead));
      if (side == 0) {
        at = ahead;
        break;
      }
      e = side > 0 ? next(f) : prev(f);
    }
  }
  visit_star(at);
}

/// Makes vertices where s crosses others. They go again if nothing leads through them.
void Triangulation::make_crossings(SegmentId s) {
  const auto [a, b] = ends_of(s);
  crossings_.clear();
  trace(s, [&, a = a, b = b](EdgeId e) {
    for (const Passage passage : passages(e)) {
      const auto [c, d] = ends_of(passage.segment());
      if (crosses(a, b, c, d)) crossings_.push_back(intersection(a, b, c, d));
    }
  });
  std::ranges::sort(crossings_);
  crossings_.erase(std::unique(crossings_.begin(), crossings_.end()), crossings_.end());
  for (const Point place : crossings_) {
    const Location there = locate(place, edge(segment(s).from));
    if (there.kind == Location::Kind::vertex) continue;
    if (there.kind == Location::Kind::edge) doubt_others_on(there.edge, place);
    const VertexId v = split_at(there, place);
    loosen(v);
    settle_around(v);
  }
}

/// The vertices that a point of s rounds to, in order; the last one is its end. Those that are no
/// corners of triangles which its line crosses are beside vertices hardly beside it.
void Triangulation::gather_stops(SegmentId s) {
  const Segment segment = this->segment(s);
  const Point a = point(segment.from);
  const Point b = point(segment.to);
  stops_.assign({segment.from, segment.to});
  trace(s, [&](EdgeId e) {
    for (const VertexId v : {from(e), to(e)})
      if (v != infinite && is_hardly_beside(a, b, point(v), 2)) stops_.push_back(v);
  });
  keep_each_once(stops_);
  is_in_crowd_.resize(points_.size());
  for (const VertexId v : stops_) is_in_crowd_[v.index()] = true;
  for (std::size_t i = 0; i < stops_.size(); ++i) {
    const EdgeId first = edge(stops_[i]);
    EdgeId e = first;
    do {
      const VertexId v = to(e);
      if (v != infinite && !is_in_crowd_[v.index()] && is_hardly_beside(a, b, point(v), 2)) {
        is_in_crowd_[v.index()] = true;
        stops_.push_back(v);
      }
      e = rotated(e);
    } while (e != first);
  }
  for (const VertexId v : stops_) is_in_crowd_[v.index()] = false;
  std::erase_if(stops_,
                [&](VertexId v) { return v == segment.from || !rounds_to(a, b, point(v)); });
  std::ranges::sort(stops_,
                    [&](VertexId v, VertexId w) { return is_ahead(point(v), point(w), a, b); });
}

/// From one vertex to the next. There ought to be nothing between them; where there is, the way
/// leads through what is nearest to the segment, if need be off the straight line.
void Triangulation::lay_between(VertexId at, VertexId stop, SegmentId s) {
  goals_.assign(1, stop);
  int detours = 0;
  while (!goals_.empty()) {
    const VertexId goal = goals_.back();
    if (goal == at) {
      goals_.pop_back();
      continue;
    }
    if (detours > most_detours) {
      for (const VertexId v : goals_) loosen(v);  // made for this segment, perhaps in vain
      follow_corridor(at, stop, s);
      return;
    }
    const Obstacle obstacle = walk(at, goal, point(at), point(goal));
    if (obstacle.kind == Obstacle::Kind::constrained_edge) {
      ++detours;
      doubt(s, point(at));
      crowded_.push_back(s);  // what is in the way may go
      for (const Passage passage : passages(obstacle.edge)) crowded_.push_back(passage.segment());
      goals_.push_back(detour(obstacle.edge, at, goal, s));
      continue;
    }
    if (obstacle.kind == Obstacle::Kind::confusion) return;  // cannot be: the line is from `at`
    const bool is_edge = obstacle.kind == Obstacle::Kind::edge_along;
    const EdgeId e = is_edge ? obstacle.edge : force_edge(at, obstacle.vertex);
    mark(e, s);
    unsettled_.emplace_back(at, to(e));
    at = to(e);
    if (at == goal) continue;
    doubt(s, point(at));
    ++detours;
  }
}

/// A vertex through which s gets past the edge e, which rounding alone has put there, on its way
/// from `at` to `goal`.
VertexId Triangulation::detour(EdgeId e, VertexId at, VertexId goal, SegmentId s) {
  const auto [a, b] = ends_of(s);
  const auto is_near = [&, a = a, b = b](VertexId v) {
    return exact_distance(a, b, point(v)) <= most_astray(a, b) / 2;
  };
  for (const Passage passage : passages(e)) doubt(passage.segment(), point(at));
  const Point place = intersection(point(at), point(goal), point(from(e)), point(to(e)));
  VertexId nearest;
  for (const VertexId v : {from(e), to(e)})
    if (v != at && is_near(v) &&
        (nearest.is_none() || distance(point(v), place) < distance(point(nearest), place)))
      nearest = v;
  if (!nearest.is_none()) return nearest;
  if (!can_split(e, place)) return snap(e, place, s);
  const VertexId v = split_edge_at(e, place);
  note_crowd(v);
  loosen(v);
  return v;
}

}  // namespace loft::cdt
