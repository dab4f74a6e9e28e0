// SPDX-License-Identifier: MIT
#include "paths/gaps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "cdt/each_once.h"
#include "cdt/predicates.h"
#include "paths/corners.h"
#include "paths/directions.h"
#include "paths/distance.h"
#include "paths/exact_distance.h"
#include "paths/free_space.h"

namespace loft::paths {

using cdt::ConstraintId;
using cdt::SegmentId;

namespace {

/// As far as a corner looks for what it is nearest to, in triangles.
constexpr int furthest_look = 64;

/// Whether q, on the line ab, is the foot of the perpendicular from p there, as foot_on() has it.
/// Mostly that is clear before it is rounded.
[[nodiscard]] bool is_foot_of(Point p, Point a, Point b, Point q, double length) {
  constexpr double near = 0x1p-30;
  const Direction along{b.x - a.x, b.y - a.y};
  const double off = std::abs(dot({p.x - q.x, p.y - q.y}, along)) / length_of(along);
  const double size = std::max({std::abs(q.x), std::abs(q.y), length});
  if (off > 0x1p-20 * length + 0x1p-40 * size) return false;
  if (off <= near / 2 * length && size <= 0x1p14 * length) return true;
  return distance_between(foot_on(p, a, b), q) <= near * length;
}

}  // namespace

/// A second point on the perpendicular need not be on it exactly: the answer is on the line ab.
Point foot_on(Point p, Point a, Point b) {
  const Point ahead{p.x - (b.y - a.y), p.y + (b.x - a.x)};
  return cdt::orient(a, b, p) == 0 ? p : cdt::intersection(a, b, p, ahead);
}

char Gaps::Cross::operator()(EdgeId e, char here) const {
  for (const cdt::Passage passage : gaps->mesh_.passages(e)) {
    const ConstraintId c = gaps->mesh_.segment(passage.segment()).constraint;
    const Wall& wall = gaps->walls_[c.index()];
    // e has `here` on its left.
    here =
        (gaps->mesh_.is_forward(e, passage) ? wall.is_free_on_right : wall.is_free_on_left) ? 1 : 0;
  }
  return here;
}

bool Gaps::is_blocked(const FreeSpace& space, EdgeId e) {
  const EdgeId twin = space.mesh().twin(e);
  return space.beyond(e).is_none() && (space.is_free(Triangulation::triangle(e)) ||
                                       space.is_free(Triangulation::triangle(twin)));
}

/// Of the two edges there the upward one.
Gaps::Edit Gaps::wall_at(const FreeSpace& space, EdgeId e) const {
  const Triangulation& mesh = space.mesh();
  const TriangleId left = Triangulation::triangle(e);
  const TriangleId right = Triangulation::triangle(mesh.twin(e));
  return {
      .from = mesh.point(mesh.from(e)),
      .to = mesh.point(mesh.to(e)),
      .wall = {.is_free_on_left = space.is_free(left), .is_free_on_right = space.is_free(right)},
      .edge = e,
      .constraint = {}};
}

void Gaps::build(const FreeSpace& space) {
  mesh_.clear();
  walls_.clear();
  is_foot_.clear();
  ways_.clear();
  wall_of_.assign(space.mesh().edge_bound(), ConstraintId::none());
  gone_.clear();
  come_.clear();
  const Triangulation& mesh = space.mesh();
  std::vector<std::array<Point, 2>> places;
  for (std::uint32_t i = 0; i < mesh.edge_bound(); ++i) {
    const EdgeId e(i);
    if (!mesh.is_triangle(Triangulation::triangle(e)) || !mesh.is_constrained(e)) continue;
    if (mesh.point(mesh.to(e)) < mesh.point(mesh.from(e)) || !is_blocked(space, e)) continue;
    come_.push_back(wall_at(space, e));
    places.push_back({come_.back().from, come_.back().to});
  }
  std::vector<cdt::Polyline> lines;
  for (const auto& place : places) lines.push_back({place});
  mesh_.record_changes(false);
  const std::vector<ConstraintId> laid = mesh_.insert(lines);
  mesh_.record_changes(true);
  for (std::size_t i = 0; i < laid.size(); ++i) {
    walls_.resize(std::max<std::size_t>(walls_.size(), laid[i].index() + 1));
    walls_[laid[i].index()] = come_[i].wall;
    wall_of_[come_[i].edge.index()] = laid[i];
  }
  free_.begin();
  made_.clear();
  for (std::uint32_t i = 0; i < mesh_.triangle_bound(); ++i)
    if (mesh_.is_triangle(TriangleId(i))) made_.push_back(TriangleId(i));
  take_over();
  settle();
}

void Gaps::follow(const FreeSpace& space, std::span<const TriangleId> unmade,
                  std::span<const TriangleId> touched) {
  wall_of_.resize(space.mesh().edge_bound());
  gone_.clear();
  come_.clear();
  for (const TriangleId t : unmade)
    for (unsigned corner = 0; corner < 3; ++corner)
      if (const EdgeId e = Triangulation::edge(t, corner); has_wall(e)) take_out(e);
  for (const TriangleId t : touched)
    for (unsigned corner = 0; corner < 3; ++corner) {
      const EdgeId e = Triangulation::edge(t, corner);
      if (space.mesh().is_constrained(e) || has_wall(e) || has_wall(space.mesh().twin(e)))
        check(space, e);
    }
  keep_common();
  if (gone_.empty() && come_.empty()) return;
  mesh_.begin_batch();
  remove_gone();
  for (Edit& edit : come_) lay(edit);
  mesh_.end_batch();
  take_over_edit();
  settle();
}

/// The wall of an edge is gone, if it had one.
void Gaps::take_out(EdgeId e) {
  if (!has_wall(e)) return;
  const ConstraintId c = std::exchange(wall_of_[e.index()], ConstraintId::none());
  const cdt::Segment& wall = mesh_.segments(c)[0];
  gone_.push_back({mesh_.point(wall.from), mesh_.point(wall.to), walls_[c.index()], e, c});
}

/// Whether an edge, or its twin, has a wall may have changed.
void Gaps::check(const FreeSpace& space, EdgeId e) {
  const Triangulation& mesh = space.mesh();
  if (mesh.from(e) == Triangulation::infinite || mesh.to(e) == Triangulation::infinite) return;
  if (mesh.point(mesh.to(e)) < mesh.point(mesh.from(e))) e = mesh.twin(e);
  const ConstraintId known = wall_of_[e.index()];
  if (!is_blocked(space, e)) return take_out(e);
  const Edit now = wall_at(space, e);
  if (!known.is_none() && walls_[known.index()] == now.wall) return;
  take_out(e);
  const bool is_listed =
      std::ranges::any_of(come_, [&](const Edit& other) { return other.edge == e; });
  if (!is_listed) come_.push_back(now);
}

/// What went and came back at the same place stays.
void Gaps::keep_common() {
  const auto is_before = [](const Edit& a, const Edit& b) {
    return a.from != b.from ? a.from < b.from : a.to < b.to;
  };
  std::ranges::sort(gone_, is_before);
  std::ranges::sort(come_, is_before);
  auto gone = gone_.begin();
  auto kept = gone_.begin();
  std::erase_if(come_, [&](const Edit& edit) {
    while (gone != gone_.end() && is_before(*gone, edit)) *kept++ = *gone++;
    if (gone == gone_.end() || !gone->is_at(edit)) return false;
    wall_of_[edit.edge.index()] = gone->constraint;
    ++gone;
    return true;
  });
  gone_.erase(kept, gone);
}

void Gaps::lay(Edit& edit) {
  const std::array<Point, 2> points{edit.from, edit.to};
  edit.constraint = mesh_.insert(points, cdt::open);
  walls_.resize(std::max<std::size_t>(walls_.size(), edit.constraint.index() + 1));
  walls_[edit.constraint.index()] = edit.wall;
  wall_of_[edit.edge.index()] = edit.constraint;
}

/// Walls, and the feet on them.
void Gaps::remove_gone() {
  idle_.clear();
  walls_gone_.clear();
  for (const Edit& edit : gone_) {
    walls_gone_.push_back(edit.constraint);
    const cdt::Segment& wall = mesh_.segments(edit.constraint)[0];
    if (mesh_.find_edge(wall.from, wall.to)) continue;  // nothing on it
    for (const EdgeId e : mesh_.pieces(edit.constraint)) {
      const VertexId v = mesh_.to(e);
      if (!is_foot(v)) continue;
      is_foot_[v.index()] = false;
      idle_.push_back(v);
    }
  }
  mesh_.remove(walls_gone_, idle_);
}

/// What was edited is in made_ then, with all that belongs to it.
void Gaps::take_over_edit() {
  free_.follow(mesh_.changes());
  made_.assign(mesh_.changes().made.begin(), mesh_.changes().made.end());
  made_.insert(made_.end(), free_.changed().begin(), free_.changed().end());
  take_over();
}

/// Takes out feet that are idle, and puts in others until there are no new ones.
void Gaps::settle() {
  find_idle_feet();
  for (int round = 0; round < furthest_look; ++round) {
    find_feet();
    if (idle_.empty() && feet_.empty()) return;
    mesh_.begin_batch();
    remove_idle_feet();
    for (const Point& p : feet_) insert_foot(p);
    mesh_.end_batch();
    take_over_edit();
  }
}

void Gaps::remove_idle_feet() {
  if (idle_.empty()) return;
  for (const VertexId v : idle_) is_foot_[v.index()] = false;
  mesh_.remove({}, idle_);
  idle_.clear();
}

void Gaps::insert_foot(Point p) {
  const std::size_t known = mesh_.vertex_count();
  const VertexId v = mesh_.insert(p);
  if (mesh_.vertex_count() == known) return mesh_.remove(v);
  if (v.index() >= is_foot_.size()) is_foot_.resize(v.index() + 1);
  is_foot_[v.index()] = true;
}

void Gaps::find_feet() {
  feet_.clear();
  for (const VertexId v : around_)
    if (mesh_.is_vertex(v) && !is_foot(v)) look_around(v);
  cdt::keep_each_once(feet_);
}

/// Looks from a corner over what is free there, where that is more than half a turn: else one of
/// the walls that bound it comes nearer to any side.
void Gaps::look_around(VertexId v) {
  const EdgeId first = mesh_.edge(v);
  EdgeId e = first;
  do {
    const EdgeId last = corner(e);
    if (!last.is_none() && beyond(e).is_none()) look_between(e, last);
    e = mesh_.rotated(e);
  } while (e != first);
}

/// Through triangles that were made, or all where the walls are new.
void Gaps::look_between(EdgeId first, EdgeId last) {
  const bool is_all_new = is_made(first) || is_made(last);
  EdgeId one = first;
  while (!is_all_new && !is_made(one)) {
    if (one == last) return;
    one = mesh_.rotated(one);
  }
  const VertexId v = mesh_.from(first);
  const Sight sight{mesh_.point(v), along_wall(first, v), along_wall(Triangulation::prev(last), v)};
  for (;; one = mesh_.rotated(one)) {
    if (is_all_new || is_made(one)) find_foot(sight, Triangulation::next(one), 0);
    if (one == last) return;
  }
}

/// From one end of the whole wall along an edge.
Direction Gaps::along_wall(EdgeId e, VertexId end) const {
  const cdt::Segment& wall = mesh_.segment(mesh_.passages(e)[0].segment());
  const Point from = mesh_.point(end);
  const Point to = mesh_.point(wall.from == end ? wall.to : wall.from);
  const double length = distance_between(from, to);
  return {(to.x - from.x) / length, (to.y - from.y) / length};
}

/// Beyond an edge, seen from its left: a wall there, as long as nothing else is nearer: the disc
/// over the way to the foot can only be empty while the perpendicular to each edge between meets
/// that, and while no wall from where one looks comes nearer to the foot.
void Gaps::find_foot(const Sight& sight, EdgeId e, int depth) {
  const Point p = sight.from;
  const Point a = mesh_.point(mesh_.from(e));
  const Point b = mesh_.point(mesh_.to(e));
  if (depth == furthest_look || !has_foot_between(p, a, b)) return;
  const auto towards = [&](Point to) { return Direction{to.x - p.x, to.y - p.y}; };
  if (sight.is_narrower_between(towards(a), towards(b))) return;
  const EdgeId twin = beyond(e);
  if (!twin.is_none()) {
    find_foot(sight, Triangulation::next(twin), depth + 1);
    find_foot(sight, Triangulation::prev(twin), depth + 1);
    return;
  }
  const Direction straight{b.y - a.y, a.x - b.x};
  if (!mesh_.is_constrained(e) || sight.is_narrower_between(straight, straight)) return;
  const cdt::Segment& side = mesh_.segment(mesh_.passages(e)[0].segment());
  const Point foot = foot_on(p, mesh_.point(side.from), mesh_.point(side.to));
  if (foot != a && foot != b && foot != p) feet_.push_back(foot);
}

/// Whether one of the walls clearly comes nearer to all that is seen between two directions: then
/// there are narrower gaps beside.
bool Gaps::Sight::is_narrower_between(Direction a, Direction b) const {
  constexpr double clearly = 0x1p-20;
  const auto comes_nearer = [](Direction wall, Direction to) {
    return dot(wall, to) > clearly * (std::abs(to.x) + std::abs(to.y));
  };
  return (comes_nearer(first, a) && comes_nearer(first, b)) ||
         (comes_nearer(last, a) && comes_nearer(last, b));
}

/// Feet from which no gap leads on any more.
void Gaps::find_idle_feet() {
  idle_.clear();
  for (const VertexId v : around_)
    if (is_foot(v) && is_idle(v)) idle_.push_back(v);
}

bool Gaps::is_idle(VertexId foot) const {
  const EdgeId first = mesh_.edge(foot);
  EdgeId e = first;
  do {
    if (!beyond(e).is_none() && std::isfinite(width(e))) return false;
    e = mesh_.rotated(e);
  } while (e != first);
  return true;
}

/// Sides, widths and corners of what was made.
void Gaps::take_over() {
  ways_.resize(mesh_.edge_bound());
  made_in_.resize(mesh_.triangle_bound());
  is_around_.resize(mesh_.vertex_bound());
  around_.clear();
  ++round_;
  for (const TriangleId t : made_) made_in_[t.index()] = round_;
  for (const TriangleId t : made_) {
    for (unsigned corner = 0; corner < 3; ++corner) {
      const EdgeId e = Triangulation::edge(t, corner);
      open_side(e);
      ways_[e.index()].corner = EdgeId::none();
      const VertexId v = mesh_.from(e);
      if (v == Triangulation::infinite || is_around_[v.index()]) continue;
      is_around_[v.index()] = true;
      around_.push_back(v);
    }
  }
  for (const VertexId v : around_) {
    is_around_[v.index()] = false;
    if (is_foot(v)) continue;
    turn_corners(
        mesh_, v, [this](TriangleId t) { return is_free(t); },
        [this](EdgeId e) { return beyond(e); },
        [this](EdgeId e, EdgeId last) { ways_[e.index()].corner = last; });
  }
}

/// Whether a side can be crossed, and the gap along it, from both sides of it.
void Gaps::open_side(EdgeId e) {
  const EdgeId twin = mesh_.twin(e);
  if (twin < e && is_made(twin)) return;
  const bool is_open = !mesh_.is_constrained(e) && is_free(Triangulation::triangle(e)) &&
                       is_free(Triangulation::triangle(twin));
  Way& there = ways_[e.index()];
  Way& back = ways_[twin.index()];
  there.beyond = is_open ? twin : EdgeId::none();
  back.beyond = is_open ? e : EdgeId::none();
  if (is_open) there.width = back.width = gap(e);
}

/// The segment that a foot is on.
SegmentId Gaps::side_with(VertexId foot) const {
  EdgeId e = mesh_.edge(foot);
  while (!mesh_.is_constrained(e)) e = mesh_.rotated(e);
  return mesh_.passages(e)[0].segment();
}

double Gaps::gap(EdgeId e) const {
  VertexId p = mesh_.from(e);
  VertexId q = mesh_.to(e);
  const double length = distance_between(mesh_.point(p), mesh_.point(q));
  if (!is_foot(p) && !is_foot(q)) return length;
  if (is_foot(p) && is_foot(q)) return std::numeric_limits<double>::infinity();
  if (is_foot(p)) std::swap(p, q);
  const cdt::Segment& side = mesh_.segment(side_with(q));
  const bool is_its_foot = is_foot_of(mesh_.point(p), mesh_.point(side.from), mesh_.point(side.to),
                                      mesh_.point(q), length);
  return is_its_foot ? length : std::numeric_limits<double>::infinity();
}

bool Gaps::is_passable_exactly(EdgeId e, double radius) const {
  VertexId p = mesh_.from(e);
  VertexId q = mesh_.to(e);
  if (is_foot(p)) std::swap(p, q);
  if (!is_foot(q)) return is_as_far(mesh_.point(p), mesh_.point(q), 2 * radius);
  const cdt::Segment& side = mesh_.segment(side_with(q));
  return is_as_far_from_line(mesh_.point(p), mesh_.point(side.from), mesh_.point(side.to),
                             2 * radius);
}

}  // namespace loft::paths
