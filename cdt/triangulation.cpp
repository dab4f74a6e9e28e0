// SPDX-License-Identifier: MIT
#include "cdt/triangulation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "cdt/blocks.h"
#include "cdt/each_once.h"
#include "cdt/predicates.h"

namespace loft::cdt {

Triangulation::Triangulation(double epsilon) : epsilon_(epsilon) {
  if (!(epsilon >= 0) || epsilon > largest_coordinate)
    throw std::invalid_argument("epsilon must be a finite number that is not negative");
  clear();
}

void Triangulation::clear() {
  edges_.clear();
  triangle_bound_ = 0;
  edge_sets_.clear();
  constexpr double infinity = std::numeric_limits<double>::infinity();
  points_.assign(1, Point{infinity, infinity});
  vertex_edges_.assign(1, EdgeId::none());
  uses_.assign(1, unused);
  traits_.clear();
  constraints_.clear();
  without_length_.clear();
  segments_.clear();
  sets_.clear();
  free_triangles_.clear();
  free_vertices_.clear();
  free_constraints_.clear();
  free_segments_.assign(size_classes, unused);
  dense_segments_ = unused;
  snaps_.clear();
  locator_.clear();
  changes_ = {};
  touched_.clear();
  last_ = EdgeId::none();
  only_ = VertexId::none();
  vertex_count_ = 0;
  reserved_ = VertexId::none();
  is_flat_ = true;
  has_bends_ = false;
  is_surrounded_ = true;
  is_crowded_ = true;
}

void Triangulation::reserve(std::size_t vertices) {
  points_.reserve(vertices + 1);
  vertex_edges_.reserve(vertices + 1);
  uses_.reserve(vertices + 1);
  edges_.reserve(6 * vertices);
  segments_.reserve(vertices);
}

// --- Edits ---

void Triangulation::check_usable(std::span<const Point> points) {
  if (points.empty()) throw std::invalid_argument("a constraint needs a point");
  for (const Point p : points)
    if (!is_usable(p))
      throw std::invalid_argument(
          "coordinates must be 0 or between 1e-50 and 1e75 in magnitude, and finite");
}

void Triangulation::check_known(ConstraintId id) const {
  if (!is_constraint(id))
    throw std::invalid_argument("there is no constraint " +
                                (id.is_none() ? "none" : std::to_string(id.index())));
}

void Triangulation::begin_edit() {
  edited_.clear();
  if (!is_in_batch_) touched_.clear();
}

void Triangulation::end_edit() {
  if (!crowded_.empty() || !loose_.empty()) settle_loose();
  if (!snaps_.empty()) tidy_snaps();
  if (is_recording_ && !is_in_batch_) sum_up_changes();
}

/// By triangle: eight bits at a time where there are many, and no more than ids have.
void Triangulation::sort_touched() {
  constexpr std::size_t few = 64;
  if (touched_.size() < few) {
    std::ranges::sort(touched_);
    return;
  }
  touched_before_.resize(touched_.size());
  for (unsigned shift = 0; triangle_bound_ >> shift != 0; shift += 8) {
    std::array<std::uint32_t, 256> place{};
    const auto digit = [&](Touch touch) { return touch.triangle().index() >> shift & 255U; };
    for (const Touch touch : touched_) ++place[digit(touch)];
    std::uint32_t sum = 0;
    for (std::uint32_t& count : place) sum += std::exchange(count, sum);
    for (const Touch touch : touched_) touched_before_[place[digit(touch)]++] = touch;
    std::swap(touched_, touched_before_);
  }
}

void Triangulation::sum_up_changes() {
  changes_.made.clear();
  changes_.unmade.clear();
  changes_.moved.clear();
  sort_touched();
  for (const Touch touch : touched_) {
    if (touch.was_there()) changes_.unmade.push_back(touch.triangle());
    if (touch.has_only_moved()) changes_.moved.push_back(touch.triangle());
    if (is_triangle(touch.triangle())) changes_.made.push_back(touch.triangle());
  }
}

void Triangulation::record_changes(bool is_on) {
  is_recording_ = is_on;
  changes_ = {};
  touched_.clear();
}

void Triangulation::begin_batch() {
  is_in_batch_ = true;
  changes_ = {};
  touched_.clear();
}

void Triangulation::end_batch() {
  is_in_batch_ = false;
  if (is_recording_) sum_up_changes();
}

ConstraintId Triangulation::insert(std::span<const Point> points, Ends ends) {
  check_usable(points);
  begin_edit();
  const std::size_t known_snaps = snaps_.size();
  insert_points(points);
  const ConstraintId id = new_constraint();
  describe(id, inserted_, ends);
  lay_all(id);
  if (known_snaps > 0) {
    note_edited(id);
    straighten(known_snaps);
  }
  end_edit();
  return id;
}

VertexId Triangulation::insert(Point point) {
  check_usable({&point, 1});
  begin_edit();
  insert_points({&point, 1});
  end_edit();
  return inserted_[0];
}

std::optional<VertexId> Triangulation::split(EdgeId e, Point point) {
  if (!is_triangle(triangle(e))) throw std::invalid_argument("there is no such edge");
  check_usable({&point, 1});
  if (!can_split(e, point)) return {};
  begin_edit();
  has_bends_ = true;
  doubt_others_on(e, point);
  const VertexId v = split_at({Location::Kind::edge, e}, point);
  note_crowd(v);
  ++uses_[v.index()];
  end_edit();
  return v;
}

std::optional<VertexId> Triangulation::split(TriangleId t, Point point) {
  if (!is_triangle(t)) throw std::invalid_argument("there is no such triangle");
  check_usable({&point, 1});
  if (is_infinite(t)) return {};
  for (unsigned corner = 0; corner < 3; ++corner) {
    const EdgeId e = edge(t, corner);
    if (orient(this->point(from(e)), this->point(to(e)), point) <= 0) return {};
  }
  begin_edit();
  const VertexId v = split_at({Location::Kind::triangle, edge(t)}, point);
  note_crowd(v);
  ++uses_[v.index()];
  end_edit();
  return v;
}

ConstraintId Triangulation::new_constraint() {
  if (free_constraints_.empty()) {
    constraints_.emplace_back();
    return ConstraintId(static_cast<std::uint32_t>(constraints_.size() - 1));
  }
  const ConstraintId id = free_constraints_.back();
  free_constraints_.pop_back();
  return id;
}

/// Notes the vertices of a constraint and its segments, which are yet to be laid.
void Triangulation::describe(ConstraintId id, std::span<const VertexId> vertices, Ends ends) {
  const auto n = static_cast<std::uint32_t>(vertices.size());
  const std::uint32_t count = ends == closed && n > 1 ? n : n - 1;
  const std::uint32_t first = count == 0 ? 0 : take_segments(count);
  for (std::uint32_t i = 0; i < count; ++i)
    segments_[first + i] = {vertices[i], vertices[i + 1 < n ? i + 1 : 0], id};
  Constraint& constraint = constraints_[id.index()];
  constraint.first_vertex = vertices[0];
  constraint.first_segment = first;
  constraint.segment_count = count & 0x7fff'ffff;
  constraint.is_closed = ends == closed ? 1 : 0;
  if (!is_without_length(id)) return;
  if (without_length_.size() <= vertices[0].index()) without_length_.resize(points_.size());
  constraint.next_here = without_length_[vertices[0].index()];
  without_length_[vertices[0].index()] = id;
}

void Triangulation::lay_all(ConstraintId id) {
  const Constraint constraint = constraints_[id.index()];
  if (!crowded_.empty()) lay_crowded();
  for (std::uint32_t i = 0; i < constraint.segment_count; ++i)
    lay(SegmentId(constraint.first_segment + i));
  if (!loose_.empty()) settle_loose();
}

bool Triangulation::is_without_length(ConstraintId id) const {
  return std::ranges::all_of(segments(id), [](const Segment& s) { return s.from == s.to; });
}

/// As long as nothing is removed blocks follow each other without gaps.
std::uint32_t Triangulation::take_segments(std::uint32_t count) {
  const bool is_dense = dense_segments_ == unused;
  const auto [index, rounded] = size_class(count);
  std::uint32_t& head = free_segments_[index];
  if (head != unused) {
    const std::uint32_t first = head;
    head = segments_[first].from.index();
    return first;
  }
  const std::size_t first = segments_.size();
  const std::size_t end = first + (is_dense ? count : rounded);
  if (end >= PassageSets::most_segments) throw std::length_error("too many segments");
  segments_.resize(end);
  return static_cast<std::uint32_t>(first);
}

void Triangulation::give_segments(std::uint32_t first, std::uint32_t count) {
  if (dense_segments_ == unused) dense_segments_ = static_cast<std::uint32_t>(segments_.size());
  auto [index, size] = size_class(count);
  if (first < dense_segments_ && size > count) --index;  // the largest class that fits in
  segments_[first].from = VertexId(free_segments_[index]);
  free_segments_[index] = first;
}

void Triangulation::free_segments(ConstraintId id) {
  const Constraint& constraint = constraints_[id.index()];
  if (constraint.segment_count == 0) return;
  for (std::uint32_t i = 0; i < constraint.segment_count; ++i)
    segments_[constraint.first_segment + i] = {};
  give_segments(constraint.first_segment, constraint.segment_count);
}

// --- Looking things up ---

std::optional<EdgeId> Triangulation::find_edge(VertexId a, VertexId b) const {
  const EdgeId e = edge_between(a, b);
  if (e.is_none()) return {};
  return e;
}

/// Around both vertices in step.
EdgeId Triangulation::edge_between(VertexId a, VertexId b) const {
  const EdgeId first_at_a = edge(a);
  const EdgeId first_at_b = edge(b);
  if (first_at_a.is_none() || first_at_b.is_none()) return EdgeId::none();
  EdgeId e = first_at_a;
  EdgeId f = first_at_b;
  do {
    if (to(e) == b) return e;
    if (to(f) == a) return twin(f);
    e = rotated(e);
    f = rotated(f);
  } while (e != first_at_a && f != first_at_b);
  return EdgeId::none();
}

std::span<const Segment> Triangulation::segments(ConstraintId c) const {
  const Constraint& constraint = constraints_[c.index()];
  return {segments_.data() + constraint.first_segment, constraint.segment_count};
}

SegmentId Triangulation::first_segment(ConstraintId c) const {
  return SegmentId(constraints_[c.index()].first_segment);
}

std::vector<Point> Triangulation::points(ConstraintId c) const {
  std::vector<Point> points;
  for_each_point(c, [&](VertexId v) { points.push_back(point(v)); });
  return points;
}

std::vector<EdgeId> Triangulation::pieces(SegmentId s) const {
  std::vector<EdgeId> found;
  VertexId at = segment(s).from;
  while (at != segment(s).to) {
    const EdgeId first = edge(at);
    EdgeId ahead = EdgeId::none();
    std::size_t ways = 0;
    EdgeId e = first;
    do {
      for (const Passage passage : passages(e))
        if (passage.segment() == s && is_forward(e, passage)) {
          ahead = e;
          ++ways;
        }
      e = rotated(e);
    } while (e != first);
    if (ways != 1) return tangled_pieces(s);
    found.push_back(ahead);
    at = to(ahead);
  }
  return found;
}

/// Hierholzer's way to find a trail: rounding has led the segment in loops.
std::vector<EdgeId> Triangulation::tangled_pieces(SegmentId s) const {
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

std::vector<EdgeId> Triangulation::pieces(ConstraintId c) const {
  std::vector<EdgeId> found;
  const SegmentId first = first_segment(c);
  for (std::uint32_t i = 0; i < segments(c).size(); ++i) {
    const auto more = pieces(SegmentId(first.index() + i));
    found.insert(found.end(), more.begin(), more.end());
  }
  return found;
}

std::vector<ConstraintId> Triangulation::constraints(EdgeId e) const {
  std::vector<ConstraintId> found;
  for (const Passage passage : passages(e)) found.push_back(segment(passage.segment()).constraint);
  keep_each_once(found);
  return found;
}

std::vector<ConstraintId> Triangulation::constraints(VertexId v) const {
  std::vector<ConstraintId> found;
  if (v.index() < without_length_.size())
    for (ConstraintId c = without_length_[v.index()]; !c.is_none();
         c = constraints_[c.index()].next_here)
      found.push_back(c);
  if (const EdgeId first = edge(v); !first.is_none()) {
    EdgeId e = first;
    do {
      for (const Passage passage : passages(e))
        found.push_back(segment(passage.segment()).constraint);
      e = rotated(e);
    } while (e != first);
  }
  keep_each_once(found);
  return found;
}

/// Whether a constraint ends at a vertex, or a segment of it.
bool Triangulation::may_have_points_at(VertexId v) const {
  if (v.index() < without_length_.size() && !without_length_[v.index()].is_none()) return true;
  const EdgeId first = edge(v);
  if (first.is_none()) return false;
  EdgeId e = first;
  do {
    for (const Passage passage : passages(e))
      if (ends_at(passage.segment(), v)) return true;
    e = rotated(e);
  } while (e != first);
  return false;
}

/// Points of constraints at a vertex: what remains of its uses are insert(Point)s and split()s.
std::size_t Triangulation::count_points_at(VertexId v) const {
  std::size_t count = 0;
  if (!may_have_points_at(v)) return count;
  for (const ConstraintId c : constraints(v))
    for_each_point(c, [&](VertexId w) { count += w == v ? 1U : 0U; });
  return count;
}

}  // namespace loft::cdt
