// SPDX-License-Identifier: MIT
#include <algorithm>

#include "cdt/predicates.h"
#include "cdt/rounding.h"
#include "cdt/triangulation.h"

namespace loft::cdt {

void Triangulation::translate(ConstraintId id, Point by) {
  check_known(id);
  places_.clear();
  for_each_point(id, [&](VertexId v) {
    places_.push_back({point(v).x + by.x, point(v).y + by.y});
  });
  check_usable(places_);
  move_to(id, places_);
}

void Triangulation::move(ConstraintId id, std::span<const Point> points) {
  check_known(id);
  check_usable(points);
  move_to(id, points);
}

/// KBT leave this as future work: a move that is not a removal and an insertion.
void Triangulation::move_to(ConstraintId id, std::span<const Point> points) {
  begin_edit();
  note_edited(id);
  const Constraint& constraint = constraints_[id.index()];
  const std::size_t count =
      constraint.segment_count + (constraint.is_closed && constraint.segment_count > 0 ? 0U : 1U);
  const bool has_length = std::ranges::any_of(points, [&](Point p) { return p != points[0]; });
  if (count == points.size() && epsilon_ == 0 && has_length && !is_without_length(id)) {
    move_in_place(id, points);
  } else {
    replace(id, points);
  }
  note_edited(id);
  straighten(snaps_.size());
  end_edit();
}

/// Remove and insert, but for the id.
void Triangulation::replace(ConstraintId id, std::span<const Point> points) {
  const Ends ends = this->ends(id);
  take_out(id);
  insert_points(points);
  describe(id, inserted_, ends);
  lay_all(id);
}

/// Segments that share edges or are crossed come off; the others keep their edges, and their
/// vertices move together with all that is around them, as long as no triangle turns over. What
/// cannot move goes and comes back.
void Triangulation::move_in_place(ConstraintId id, std::span<const Point> points) {
  const Constraint constraint = constraints_[id.index()];
  const std::uint32_t first = constraint.first_segment;
  const std::uint32_t count = constraint.segment_count;
  const auto n = static_cast<std::uint32_t>(points.size());
  stays_.assign(count, false);
  plain_.assign(count, EdgeId::none());
  for (std::uint32_t i = 0; i < count; ++i) {
    plain_[i] = plain_edge(SegmentId(first + i));
    stays_[i] = !plain_[i].is_none();
    if (!stays_[i]) take_off(SegmentId(first + i));
  }
  settle_loose();

  inserted_.clear();
  for_each_point(id, [&](VertexId v) { inserted_.push_back(v); });
  // More than once, as one vertex may have to make way for the next.
  still_.clear();
  for (std::uint32_t i = 0; i < n; ++i)
    if (point(inserted_[i]) != points[i]) still_.push_back(i);
  constexpr int rounds = 3;
  for (int round = 0; round < rounds && !still_.empty(); ++round) {
    const std::size_t before = still_.size();
    std::erase_if(still_, [&](std::uint32_t i) { return move_vertex(inserted_[i], points[i]); });
    if (still_.size() == before) break;
  }
  for (const VertexId v : inserted_)
    if (has_moved(v)) push_around(v);
  for (const VertexId v : inserted_) uses_[v.index()] &= ~moved;
  restore_delaunay();
  for (std::uint32_t i = 0; i < count; ++i) {
    const Segment& segment = segments_[first + i];
    if (!stays_[i] || still_.size() == n) continue;
    const SegmentId s(first + i);
    const EdgeId known = plain_[i];
    const bool is_there = from(known) == segment.from && to(known) == segment.to;
    const EdgeId e = is_there ? known : edge_between(segment.from, segment.to);
    if (!e.is_none() && !settle_piece(e, s)) crowded_.push_back(s);
  }

  for (const std::uint32_t i : still_) {
    const std::uint32_t before = i > 0 ? i - 1 : constraint.is_closed ? count - 1 : count;
    for (const std::uint32_t k : {before, i}) {
      if (k >= count || !stays_[k]) continue;
      take_off(SegmentId(first + k));
      std::erase(crowded_, SegmentId(first + k));  // it is laid once its ends are there
      stays_[k] = false;
    }
  }
  for (const std::uint32_t i : still_) {
    --uses_[inserted_[i].index()];
    loose_.push_back(inserted_[i]);
  }
  settle_loose();
  for (const std::uint32_t i : still_) {
    const VertexId near = inserted_[i > 0 ? i - 1 : n - 1];
    const bool is_there = is_vertex(near) && !edge(near).is_none();
    inserted_[i] = insert_near(points[i], is_there ? edge(near) : last_);
    ++uses_[inserted_[i].index()];
  }
  constraints_[id.index()].first_vertex = inserted_[0];
  for (std::uint32_t i = 0; i < count; ++i) {
    segments_[first + i].from = inserted_[i];
    segments_[first + i].to = inserted_[i + 1 < n ? i + 1 : 0];
  }
  if (!crowded_.empty()) lay_crowded();
  for (std::uint32_t i = 0; i < count; ++i)
    if (!stays_[i]) lay(SegmentId(first + i));
  if (!loose_.empty()) settle_loose();
}

/// The edges at a moved vertex and those around it become suspects, each once for all that moved.
void Triangulation::push_around(VertexId v) {
  const auto is_for_other = [&](VertexId other) { return has_moved(other) && other < v; };
  const EdgeId first = edge(v);
  EdgeId e = first;
  do {
    const EdgeId around = next(e);
    if (!is_constrained(e) && !is_for_other(to(e))) suspects_.push_back(e);
    if (!is_constrained(around) && !has_moved(from(around)) && !has_moved(to(around)) &&
        !is_for_other(apex(twin(around))))
      suspects_.push_back(around);
    e = rotated(e);
  } while (e != first);
}

/// The edge that a segment is, if it is one that nothing else runs along; none otherwise.
EdgeId Triangulation::plain_edge(SegmentId s) const {
  const Segment& segment = this->segment(s);
  const EdgeId e = edge_between(segment.from, segment.to);
  const bool is_plain = !e.is_none() && segment.from != segment.to && passages(e).size() == 1 &&
                        passages(e)[0].segment() == s;
  return is_plain ? e : EdgeId::none();
}

/// Puts a vertex of one point elsewhere if every triangle around it stays counter-clockwise, no
/// segment beside it has to lead through it and no vertex is hardly apart.
bool Triangulation::move_vertex(VertexId v, Point p) {
  if (uses_[v.index()] != 1) return false;
  const EdgeId first = edge(v);
  EdgeId e = first;
  do {
    if (is_constrained(e) && (passages(e).size() != 1 || !ends_at(passages(e)[0].segment(), v)))
      return false;
    const EdgeId opposite = next(e);
    const VertexId a = from(opposite);
    const VertexId b = to(opposite);
    if (a == infinite || b == infinite || !is_clearly_left(point(a), point(b), p)) return false;
    e = rotated(e);
  } while (e != first);
  do {
    touch(triangle(e));
    if (is_constrained(e) && (point(v) < point(to(e))) != (p < point(to(e))))
      join(e, twin(e), sets_.reversed(side(e).set));
    e = rotated(e);
  } while (e != first);
  locator_.move(v, point(v), p, to(first));
  points_[v.index()] = p;
  uses_[v.index()] |= moved;
  return true;
}

}  // namespace loft::cdt
