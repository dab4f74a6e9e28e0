// SPDX-License-Identifier: MIT
#include <algorithm>
#include <utility>

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
  take_out({&id, 1});
  insert_points(points);
  describe(id, inserted_, ends);
  lay_all(id);
}

/// Segments that share edges or are crossed come off; the others keep their edges, and their
/// vertices move together with all that is around them, as long as no triangle turns over. What
/// cannot move goes and comes back.
void Triangulation::move_in_place(ConstraintId id, std::span<const Point> points) {
  take_off_all_but_plain(id);
  inserted_.clear();
  for_each_point(id, [&](VertexId v) { inserted_.push_back(v); });
  move_vertices(id, points);
  if (still_.size() < points.size()) settle_plain(id);
  replace_still(id, points);
  const Constraint constraint = constraints_[id.index()];
  if (!crowded_.empty()) lay_crowded();
  for (std::uint32_t i = 0; i < constraint.segment_count; ++i)
    if (!stays_[i]) lay(SegmentId(constraint.first_segment + i));
  if (!loose_.empty()) settle_loose();
}

/// Segments that stay, and their edges, are in stays_ and plain_ then.
void Triangulation::take_off_all_but_plain(ConstraintId id) {
  const Constraint constraint = constraints_[id.index()];
  const auto segment_at = [&](std::uint32_t i) { return SegmentId(constraint.first_segment + i); };
  stays_.assign(constraint.segment_count, true);
  plain_.resize(constraint.segment_count);
  const auto take_off_unless_plain = [&](std::uint32_t i) {
    stays_[i] = !plain_[i].is_none();
    if (!stays_[i]) return take_off(segment_at(i));
    vertex_edges_[from(plain_[i]).index()] = plain_[i];  // where it is found at once
  };
  for (std::uint32_t i = 0; i < constraint.segment_count; ++i) {
    plain_[i] = plain_edge(segment_at(i));
    take_off_unless_plain(i);
  }
  while (!loose_.empty()) {
    settle_loose();
    for (std::uint32_t i = 0; i < constraint.segment_count; ++i) {
      if (!stays_[i]) continue;
      plain_[i] = plain_edge_now(segment_at(i), plain_[i]);
      take_off_unless_plain(i);
    }
  }
}

/// Moves the vertices in inserted_; those that cannot move yet are in still_ then.
void Triangulation::move_vertices(ConstraintId id, std::span<const Point> points) {
  still_.clear();
  for (std::uint32_t i = 0; i < points.size(); ++i)
    if (point(inserted_[i]) != points[i]) still_.push_back(i);
  if (still_.empty()) return;
  move_together(id, points);
  // More than once, as one vertex may have to make way for the next.
  constexpr int rounds = 3;
  for (int round = 0; round < rounds && !still_.empty(); ++round) {
    const std::size_t before = still_.size();
    std::erase_if(still_, [&](std::uint32_t i) { return move_vertex(inserted_[i], points[i]); });
    if (still_.size() == before) break;
  }
  for (const VertexId v : inserted_)
    if (has_moved(v)) suspect_around(v);
  for (const VertexId v : inserted_) uses_[v.index()] &= ~moved;
  restore_delaunay();
}

/// All at once, but for those that have no room where they are to go, and those that then have none
/// beside these.
void Triangulation::move_together(ConstraintId id, std::span<const Point> points) {
  places_before_.clear();
  for (const VertexId v : inserted_) places_before_.push_back(point(v));
  moving_.clear();
  for (const std::uint32_t i : still_) {
    const VertexId v = inserted_[i];
    if (uses_[v.index()] != 1) continue;
    points_[v.index()] = points[i];
    uses_[v.index()] = moved | i;
    moving_.push_back(v);
  }
  while (!moving_.empty()) {
    const VertexId v = moving_.back();
    moving_.pop_back();
    if (has_moved(v) && !has_room_beside_moved(v)) put_back(v);
  }
  std::erase_if(still_, [&](std::uint32_t i) {
    const VertexId v = inserted_[i];
    if (!has_moved(v)) return false;
    uses_[v.index()] = moved | 1;
    locator_.move(v, places_before_[i], point(v), to(edge(v)));
    return true;
  });
  if (still_.size() < points.size()) turn_passages(id);
}

/// What has_room() says of all corners that moved, for the triangles around one of them that are
/// not to be looked at from another.
bool Triangulation::has_room_beside_moved(VertexId v) const {
  const Point place = point(v);
  const EdgeId first = edge(v);
  EdgeId e = first;
  VertexId a = to(e);
  Point at_a = point(a);
  bool is_of_a = is_for(a, v);
  do {
    if (is_constrained(e) && !(passages(e).size() == 1 && ends_at(passages(e)[0].segment(), v)))
      return false;
    const VertexId b = apex(e);
    const Point at_b = point(b);
    const bool is_of_b = is_for(b, v);
    if (b == infinite || (!is_of_a && !is_of_b && !is_clear_triangle(at_a, at_b, place)))
      return false;
    a = b;
    at_a = at_b;
    is_of_a = is_of_b;
    e = rotated(e);
  } while (e != first);
  return true;
}

/// A vertex of move_together() stays; so there is to be a look at those beside it.
void Triangulation::put_back(VertexId v) {
  points_[v.index()] = places_before_[uses_[v.index()] & ~moved];
  uses_[v.index()] = 1;
  const EdgeId first = edge(v);
  EdgeId e = first;
  do {
    if (has_moved(to(e))) moving_.push_back(to(e));
    e = rotated(e);
  } while (e != first);
}

/// What is upward now and was not before, or the other way round.
void Triangulation::turn_passages(ConstraintId id) {
  const Constraint constraint = constraints_[id.index()];
  for (std::uint32_t i = 0; i < constraint.segment_count; ++i) {
    if (!stays_[i]) continue;
    const std::uint32_t k = i + 1 < inserted_.size() ? i + 1 : 0;
    const bool was_upward = places_before_[i] < places_before_[k];
    if (was_upward == (point(inserted_[i]) < point(inserted_[k]))) continue;
    join(plain_[i], twin(plain_[i]), sets_.reversed(side(plain_[i]).set));
  }
}

/// The edges at a moved vertex and those around it become suspects where they are not Delaunay,
/// each looked at once for all that moved. Seen from the vertex, as in fan_out().
void Triangulation::suspect_around(VertexId v) {
  using detail::Sight;
  const auto suspect = [&](EdgeId e, int side) {
    if (side == 0) side = should_flip(from(e), to(e), apex(e), apex(twin(e))) ? 1 : -1;
    if (side > 0) suspects_.push_back(e);
  };
  const Point place = point(v);
  const EdgeId first = edge(v);
  EdgeId e = first;
  VertexId a = to(e);
  Sight to_before(place, point(apex(twin(e))));
  Sight to_a(place, point(a));
  bool is_of_a = is_for(a, v);
  do {
    const VertexId b = apex(e);
    const Sight to_b(place, point(b));
    const bool is_of_b = is_for(b, v);
    if (!is_of_a && !is_of_b) touch_moved(triangle(e));
    if (!is_of_a && !is_constrained(e)) suspect(e, detail::in_circle_filter(to_a, to_before, to_b));
    const EdgeId around = next(e);
    if (!is_constrained(around) && !has_moved(a) && !has_moved(b)) {
      const VertexId d = apex(twin(around));
      if (!is_for(d, v))
        suspect(around, detail::in_circle_filter(to_b, to_a, Sight(place, point(d))));
    }
    to_before = std::exchange(to_a, to_b);
    a = b;
    is_of_a = is_of_b;
    e = rotated(e);
  } while (e != first);
}

/// Leads segments that kept their edges through what is beside them now.
void Triangulation::settle_plain(ConstraintId id) {
  const Constraint constraint = constraints_[id.index()];
  for (std::uint32_t i = 0; i < constraint.segment_count; ++i) {
    if (!stays_[i]) continue;
    const SegmentId s(constraint.first_segment + i);
    const EdgeId e = plain_edge_now(s, plain_[i]);
    if (!e.is_none() && !settle_piece(e, s)) crowded_.push_back(s);
  }
}

/// Vertices that could not move make way for others, where they are to be.
void Triangulation::replace_still(ConstraintId id, std::span<const Point> points) {
  const Constraint constraint = constraints_[id.index()];
  const std::uint32_t first = constraint.first_segment;
  const std::uint32_t count = constraint.segment_count;
  const auto n = static_cast<std::uint32_t>(points.size());
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
}

/// The edge that a segment is, if it is one that nothing else runs along; none otherwise.
EdgeId Triangulation::plain_edge(SegmentId s) const {
  const Segment& segment = this->segment(s);
  const EdgeId e = edge_between(segment.from, segment.to);
  const bool is_plain = !e.is_none() && segment.from != segment.to && passages(e).size() == 1 &&
                        passages(e)[0].segment() == s;
  return is_plain ? e : EdgeId::none();
}

/// The same after other edges may have been flipped. `known`: what it was.
EdgeId Triangulation::plain_edge_now(SegmentId s, EdgeId known) const {
  const Segment& segment = this->segment(s);
  const bool is_there = from(known) == segment.from && to(known) == segment.to;
  return is_there ? known : edge_between(segment.from, segment.to);
}

/// Whether at p every triangle around v would be counter-clockwise, no segment beside it would have
/// to lead through it and no vertex be hardly apart.
bool Triangulation::has_room(VertexId v, Point p) const {
  const EdgeId first = edge(v);
  EdgeId e = first;
  do {
    if (is_constrained(e) && (passages(e).size() != 1 || !ends_at(passages(e)[0].segment(), v)))
      return false;
    const VertexId a = to(e);
    const VertexId b = apex(e);
    if (a == infinite || b == infinite || !is_clearly_left(point(a), point(b), p)) return false;
    e = rotated(e);
  } while (e != first);
  return true;
}

/// Puts a vertex of one point elsewhere if it has room there.
bool Triangulation::move_vertex(VertexId v, Point p) {
  if (uses_[v.index()] != 1 || !has_room(v, p)) return false;
  const EdgeId first = edge(v);
  EdgeId e = first;
  do {
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
