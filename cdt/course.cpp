// SPDX-License-Identifier: MIT
// Which vertices a segment leads through: those that one of its points rounds to. This is snap
// rounding (Hobby, "Practical Segment Intersection with Finite Precision Output", 1999; Guibas and
// Marimont, "Rounding Arrangements Dynamically", 1998), on the doubles in the place of a grid.
#include <algorithm>
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
  if (through == infinite) return false;
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
  restore_delaunay();
  return true;
}

/// Leads through a vertex that is new what belongs there. Returns whether that is nothing, and no
/// other vertex is hardly apart from it: then segments are to be laid anew at the end of the edit.
bool Triangulation::settle_around(VertexId v) {
  const Point place = point(v);
  bool is_crowded = false;
  const EdgeId first = edge(v);
  EdgeId e = first;
  do {
    is_crowded |= to(e) != infinite && are_hardly_apart(place, point(to(e)));
    if (is_constrained(next(e)) && lead_through_apex(next(e))) {
      settle_around(v);
      return false;
    }
    e = rotated(e);
  } while (e != first);
  settle_pieces();
  if (is_crowded) settle_crowd(v);
  return !is_crowded;
}

/// Notes the segments through vertices hardly apart from this one that have to lead through it.
void Triangulation::settle_crowd(VertexId v) {
  gather_crowd(v);
  gather_segments(v);
  const std::vector<SegmentId> here = around_;
  for (const VertexId w : crowd_) {
    gather_segments(w);
    for (const SegmentId s : around_) {
      const auto [a, b] = ends_of(s);
      if (!std::ranges::binary_search(here, s) && !ends_at(s, v) && rounds_to(a, b, point(v)))
        crowded_.push_back(s);
    }
  }
}

/// The vertices hardly apart from one, itself included.
void Triangulation::gather_crowd(VertexId v) {
  crowd_.assign(1, v);
  for (std::size_t i = 0; i < crowd_.size(); ++i) {
    const EdgeId first = edge(crowd_[i]);
    EdgeId e = first;
    do {
      const VertexId w = to(e);
      if (w != infinite && are_hardly_apart(point(v), point(w)) &&
          std::ranges::find(crowd_, w) == crowd_.end())
        crowd_.push_back(w);
      e = rotated(e);
    } while (e != first);
  }
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
  for (const SegmentId s : crowded_) take_off_around(segment(s).from, s);
  restore_delaunay();
}

/// Leads a piece of segments that is new through the vertices beside it where it belongs.
void Triangulation::settle_piece(EdgeId e) {
  const bool is_changed = lead_through_apex(e) || lead_through_apex(twin(e));
  if (is_changed) settle_pieces();
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
  take_off_around(start, s);
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
  VertexId at = segment.from;
  while (at != segment.to) {
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
      if (ahead == infinite) return;
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

/// The vertices that a point of s rounds to, as far as the triangles that its line crosses have
/// them for corners, in order; the last one is its end.
void Triangulation::gather_stops(SegmentId s) {
  const Segment segment = this->segment(s);
  const Point a = point(segment.from);
  const Point b = point(segment.to);
  stops_.assign(1, segment.to);
  const auto consider = [&](VertexId v) {
    if (v != infinite && v != segment.from && rounds_to(a, b, point(v))) stops_.push_back(v);
  };
  trace(s, [&](EdgeId e) {
    consider(from(e));
    consider(to(e));
  });
  keep_each_once(stops_);
  for (std::size_t i = 0, known = stops_.size(); i <= known; ++i) {
    gather_crowd(i < known ? stops_[i] : segment.from);
    for (const VertexId v : crowd_) consider(v);
  }
  keep_each_once(stops_);
  std::ranges::sort(stops_, [&](VertexId v, VertexId w) {
    return is_ahead(point(v), point(w), a, b);
  });
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
      goals_.push_back(detour(obstacle.edge, at, goal, s));
      continue;
    }
    const bool is_edge = obstacle.kind == Obstacle::Kind::edge_along;
    const EdgeId e = is_edge ? obstacle.edge : force_edge(at, obstacle.vertex);
    mark(e, s);
    unsettled_.emplace_back(at, to(e));
    at = to(e);
    if (at != goal) doubt(s, point(at));
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
  if (can_split(e, place)) return split_edge_at(e, place);
  return snap(e, place, s);
}

}  // namespace loft::cdt
