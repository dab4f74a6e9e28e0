// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "cdt/each_once.h"
#include "cdt/predicates.h"
#include "cdt/rounding.h"
#include "cdt/triangulation.h"

namespace loft::cdt {

/// KBT, remove_constraint: the ids come off the edges; then each vertex on the way goes if nothing
/// needs it any more.
void Triangulation::remove(ConstraintId id) { remove({&id, 1}, {}); }

void Triangulation::remove(VertexId v) { remove({}, {&v, 1}); }

void Triangulation::remove(std::span<const ConstraintId> ids, std::span<const VertexId> vertices) {
  for (const ConstraintId id : ids) check_known(id);
  for (const VertexId v : vertices) check_own_point(v);
  begin_edit();
  for (const ConstraintId id : ids) note_edited(id);
  if (!snaps_.empty())
    for (const VertexId v : vertices) edited_.emplace_back(point(v), point(v));
  take_out(ids, vertices);
  for (const ConstraintId id : ids) {
    constraints_[id.index()].first_vertex = VertexId::none();
    free_constraints_.push_back(id);
  }
  straighten(snaps_.size());
  end_edit();
}

void Triangulation::check_own_point(VertexId v) const {
  if (!is_vertex(v)) throw std::invalid_argument("there is no vertex " + std::to_string(v.index()));
  if (count_points_at(v) == uses_[v.index()])
    throw std::invalid_argument("vertex " + std::to_string(v.index()) +
                                " belongs to constraints only: remove these");
}

/// All but the ids.
void Triangulation::take_out(std::span<const ConstraintId> ids,
                             std::span<const VertexId> vertices) {
  for (const ConstraintId id : ids) {
    const Constraint constraint = constraints_[id.index()];
    for (std::uint32_t i = 0; i < constraint.segment_count; ++i)
      take_off(SegmentId(constraint.first_segment + i));
  }
  for (const ConstraintId id : ids) release_points(id);
  for (const VertexId v : vertices) {
    --uses_[v.index()];
    loose_.push_back(v);
  }
  settle_loose();
  for (const ConstraintId id : ids) free_segments(id);
  if (!ids.empty()) forget_dead_snaps();
}

/// Takes the passages of a segment off its edges. Mostly that is one edge.
void Triangulation::take_off(SegmentId s) {
  const auto [from, to, constraint] = segment(s);
  if (from != to && !may_be_tangled(s)) {
    if (const EdgeId e = edge_between(from, to); !e.is_none()) {
      if (const auto passage = find_passage(e, s)) {
        unmark(e, *passage);
        loosen(from);
        loosen(to);
        return;
      }
    }
  }
  take_off_around(from, s);
}

/// Whether rounding may have led a segment in loops, so that it has more edges than it needs.
bool Triangulation::may_be_tangled(SegmentId s) const {
  constexpr std::size_t few = 64;
  return snaps_.size() > few ||
         std::ranges::any_of(snaps_, [&](const Snap& snap) { return snap.segment == s; });
}

/// From vertex to vertex, taking what is around each: rounding may have led the segment in loops.
void Triangulation::take_off_around(VertexId start, SegmentId s) {
  const std::size_t first = goals_.size();
  goals_.push_back(start);
  while (goals_.size() > first) {
    const VertexId v = goals_.back();
    goals_.pop_back();
    loosen(v);
    const EdgeId start_edge = edge(v);
    if (start_edge.is_none()) continue;
    EdgeId e = start_edge;
    do {
      while (const auto passage = find_passage(e, s)) {
        unmark(e, *passage);
        goals_.push_back(to(e));
      }
      e = rotated(e);
    } while (e != start_edge);
  }
}

/// A vertex that lost something is to be looked at.
void Triangulation::loosen(VertexId v) {
  if (loose_.empty() || loose_.back() != v) loose_.push_back(v);
}

std::optional<Passage> Triangulation::find_passage(EdgeId e, SegmentId s) const {
  for (const Passage passage : passages(e))
    if (passage.segment() == s) return passage;
  return {};
}

void Triangulation::unmark(EdgeId e, Passage passage) {
  touch(triangle(e));
  touch(triangle(twin(e)));
  const PassageSet left = sets_.without(side(e).set, passage);
  join(e, twin(e), left);
  if (left.is_empty()) suspects_.push_back(e);
}

/// One use less of each vertex of a constraint.
void Triangulation::release_points(ConstraintId id) {
  for_each_point(id, [&](VertexId v) {
    --uses_[v.index()];
    loosen(v);
  });
  if (!is_without_length(id)) return;
  ConstraintId* link = &without_length_[first_vertex(id).index()];
  while (*link != id) link = &constraints_[link->index()].next_here;
  *link = constraints_[id.index()].next_here;
}

/// Decides about each vertex that lost something, then lays again what that took off.
void Triangulation::settle_loose() {
  constexpr int most_rounds = 8;  // what is laid again may make vertices in vain
  for (int round = 0; round == 0 || (round < most_rounds && !loose_.empty()); ++round) {
    restore_delaunay();
    if (!crowded_.empty()) lay_crowded();
    keep_each_once(loose_);
    // Others may be added on the way.
    for (std::size_t i = 0; i < loose_.size(); ++i)
      if (is_vertex(loose_[i])) examine(loose_[i]);
    loose_.clear();
    lay_again();
    if (!crowded_.empty()) lay_crowded();
  }
}

/// A vertex goes if no point of a constraint is there and no two segments cross there. One that
/// stays sheds the segments that only went through it because of what is gone.
void Triangulation::examine(VertexId v) {
  const bool is_used = uses_[v.index()] > 0;
  const EdgeId first = edge(v);
  if (first.is_none()) {  // the only vertex
    if (!is_used) delete_from_line(v);
    return;
  }
  EdgeId constrained[2] = {EdgeId::none(), EdgeId::none()};
  std::size_t degree = 0;
  bool has_passers = false;  // segments that do not end here
  EdgeId e = first;
  do {
    if (is_constrained(e)) {
      if (degree++ < 2) constrained[degree - 1] = e;
      for (const Passage passage : passages(e)) has_passers |= !ends_at(passage.segment(), v);
    }
    e = rotated(e);
  } while (e != first);
  if (is_used && !has_passers) return;

  if (degree == 0) {
    delete_vertex(v);
    return;
  }
  if (!is_used && degree == 2 && passes_straight(twin(constrained[0]), constrained[1]) &&
      delete_between(v, constrained[0], constrained[1]))
    return;
  gather_segments(v);
  const std::size_t known = taken_off_.size();
  const bool is_needed = this->is_needed(v);
  for (const SegmentId s : around_)
    if (!ends_at(s, v) && !(is_needed && is_rightly_on(s, v))) taken_off_.push_back(s);
  for (std::size_t i = known; i < taken_off_.size(); ++i) take_off_to_lay_again(taken_off_[i]);
  restore_delaunay();
}

/// What there was to doubt about it is forgotten: laying it finds out anew.
void Triangulation::take_off_to_lay_again(SegmentId s) {
  take_off_around(segment(s).from, s);
  std::erase_if(snaps_, [&](const Snap& snap) { return snap.segment == s; });
}

bool Triangulation::ends_at(SegmentId s, VertexId v) const {
  return segment(s).from == v || segment(s).to == v;
}

/// Whether the same segments, none crossing another, run along both edges, which meet in a vertex.
bool Triangulation::passes_straight(EdgeId before, EdgeId after) const {
  const auto in = passages(before);
  const auto out = passages(after);
  if (in.size() != out.size()) return false;
  const bool is_turned = is_upward(before) != is_upward(after);
  if (in.size() == 1) {
    const Passage passage = is_turned ? out[0].reversed() : out[0];
    return in[0] == passage;
  }
  for (std::size_t i = 0; i < in.size(); ++i) {
    if (std::ranges::count(in, in[i]) !=
        std::ranges::count(out, is_turned ? in[i].reversed() : in[i]))
      return false;
    for (std::size_t j = 0; j < i; ++j) {
      const auto [a, b] = ends_of(in[i].segment());
      const auto [c, d] = ends_of(in[j].segment());
      if (crosses(a, b, c, d)) return false;
    }
  }
  return true;
}

/// The segments along the edges at a vertex, each once.
void Triangulation::gather_segments(VertexId v) {
  around_.clear();
  const EdgeId first = edge(v);
  EdgeId e = first;
  do {
    for (const Passage passage : passages(e)) around_.push_back(passage.segment());
    e = rotated(e);
  } while (e != first);
  keep_each_once(around_);
}

/// Whether there has to be a vertex: because of a point, or because two of around_ cross there.
bool Triangulation::is_needed(VertexId v) const {
  if (uses_[v.index()] > 0) return true;
  for (std::size_t i = 0; i < around_.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (crosses_at(around_[i], around_[j], point(v))) return true;
  return false;
}

/// Whether a segment through v, where a vertex is needed, has to go there.
bool Triangulation::is_rightly_on(SegmentId s, VertexId v) const {
  const Point place = point(v);
  const auto [a, b] = ends_of(s);
  if (epsilon_ == 0) return rounds_to(a, b, place);
  if (uses_[v.index()] > 0 && distance_to_line(a, b, place) <= epsilon_) return true;
  return std::ranges::any_of(
      around_, [&](SegmentId other) { return other != s && crosses_at(s, other, place); });
}

/// Lays the segments that were taken off because they passed through vertices without reason.
void Triangulation::lay_again() {
  while (!taken_off_.empty()) {
    const SegmentId s = taken_off_.back();
    taken_off_.pop_back();
    lay(s);
  }
}

// --- Snaps ---

/// Where there are snaps, keeps the places of a constraint to find those near it afterwards.
void Triangulation::note_edited(ConstraintId id) {
  if (snaps_.empty()) return;
  for_each_point(id, [&](VertexId v) { edited_.emplace_back(point(v), point(v)); });
  for (const Segment& s : segments(id)) edited_.emplace_back(point(s.from), point(s.to));
}

void Triangulation::forget_dead_snaps() {
  std::erase_if(snaps_, [&](const Snap& snap) { return !is_segment(snap.segment); });
}

/// Each once, in order.
void Triangulation::tidy_snaps() {
  keep_each_once(snaps_, [](const Snap& snap) { return std::pair(snap.segment, snap.place); });
}

/// Lays the segments again that rounding led astray near the edited places, or that meet them
/// anywhere: the reason may be gone. `known_snaps` were there before the edit.
void Triangulation::straighten(std::size_t known_snaps) {
  if (edited_.empty()) return;
  constexpr double nearly = 64;
  Box box;
  for (const auto& [a, b] : edited_) {
    box.add(a);
    box.add(b);
  }
  const double slack = nearly * doubtful_rounding *
                       std::max({std::abs(box.low.x), std::abs(box.low.y), std::abs(box.high.x),
                                 std::abs(box.high.y)});
  const auto is_beyond = [&](Point low, Point high) {
    return high.x < box.low.x - slack || low.x > box.high.x + slack || high.y < box.low.y - slack ||
           low.y > box.high.y + slack;
  };
  const auto is_near = [&](Point place) {
    if (is_beyond(place, place)) return false;
    return std::ranges::any_of(edited_, [&](const auto& ends) {
      const auto& [a, b] = ends;
      if (a == b) return are_hardly_apart(a, place);
      return is_hardly_beside(a, b, place, nearly);
    });
  };
  const auto is_met = [&](SegmentId s) {
    const auto [a, b] = ends_of(s);
    if (is_beyond({a.x, std::min(a.y, b.y)}, {b.x, std::max(a.y, b.y)})) return false;
    return std::ranges::any_of(edited_, [&, a = a, b = b](const auto& ends) {
      return crosses(a, b, ends.first, ends.second) || is_hardly_beside(a, b, ends.first, nearly);
    });
  };
  for (std::size_t i = 0; i < known_snaps; ++i)
    if (is_near(snaps_[i].place) || is_met(snaps_[i].segment))
      taken_off_.push_back(snaps_[i].segment);
  if (taken_off_.empty()) return;
  keep_each_once(taken_off_);
  for (std::size_t i = 0, known = taken_off_.size(); i < known; ++i)
    take_off_to_lay_again(taken_off_[i]);
  settle_loose();
}

}  // namespace loft::cdt
