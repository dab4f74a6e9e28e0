// SPDX-License-Identifier: MIT
#include "paths/gaps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "cdt/predicates.h"
#include "paths/corners.h"
#include "paths/distance.h"
#include "paths/exact_distance.h"
#include "paths/free_space.h"

namespace loft::paths {

using cdt::ConstraintId;
using cdt::SegmentId;

namespace {

/// As far as a corner looks for what it is nearest to, in triangles.
constexpr int furthest_look = 64;

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
  beyond_.clear();
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
    for (unsigned corner = 0; corner < 3; ++corner) take_out(Triangulation::edge(t, corner));
  for (const TriangleId t : touched) {
    for (unsigned corner = 0; corner < 3; ++corner) {
      const EdgeId e = Triangulation::edge(t, corner);
      check(space, e);
      check(space, space.mesh().twin(e));
    }
  }
  keep_common();
  if (gone_.empty() && come_.empty()) return;
  mesh_.begin_batch();
  for (const Edit& edit : gone_) {
    remove_feet(edit.constraint);
    mesh_.remove(edit.constraint);
  }
  for (Edit& edit : come_) lay(edit);
  mesh_.end_batch();
  free_.follow(mesh_.changes());
  made_ = mesh_.changes().made;
  made_.insert(made_.end(), free_.changed().begin(), free_.changed().end());
  take_over();
  mesh_.begin_batch();
  remove_idle_feet(made_);
  mesh_.end_batch();
  std::vector<TriangleId> made = made_;
  free_.follow(mesh_.changes());
  made_ = mesh_.changes().made;
  made_.insert(made_.end(), free_.changed().begin(), free_.changed().end());
  take_over();
  made_.insert(made_.end(), made.begin(), made.end());
  settle();
}

/// The wall of an edge is gone, if it had one.
void Gaps::take_out(EdgeId e) {
  if (e.index() >= wall_of_.size() || wall_of_[e.index()].is_none()) return;
  const ConstraintId c = std::exchange(wall_of_[e.index()], ConstraintId::none());
  const std::vector<Point> points = mesh_.points(c);
  gone_.push_back({points[0], points[1], walls_[c.index()], e, c});
}

/// Whether an edge has a wall may have changed.
void Gaps::check(const FreeSpace& space, EdgeId e) {
  const Triangulation& mesh = space.mesh();
  if (mesh.from(e) == Triangulation::infinite || mesh.to(e) == Triangulation::infinite) return;
  if (mesh.point(mesh.to(e)) < mesh.point(mesh.from(e))) return;
  const bool is_there = !wall_of_[e.index()].is_none();
  if (!is_blocked(space, e)) return take_out(e);
  const Edit now = wall_at(space, e);
  if (is_there && walls_[wall_of_[e.index()].index()] == now.wall) return;
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

void Gaps::remove_feet(ConstraintId c) {
  std::vector<VertexId> feet;
  for (const EdgeId e : mesh_.pieces(c))
    if (is_foot(mesh_.to(e))) feet.push_back(mesh_.to(e));
  for (const VertexId v : feet) {
    is_foot_[v.index()] = false;
    mesh_.remove(v);
  }
}

/// Feet until there are no new ones.
void Gaps::settle() {
  for (int round = 0; round < furthest_look; ++round) {
    feet_.clear();
    find_feet(made_);
    std::ranges::sort(feet_);
    feet_.erase(std::unique(feet_.begin(), feet_.end()), feet_.end());
    if (feet_.empty()) return;
    mesh_.begin_batch();
    for (const Point& p : feet_) {
      if (mesh_.locate(p).kind == cdt::Location::Kind::vertex) continue;
      const VertexId v = mesh_.insert(p);
      if (v.index() >= is_foot_.size()) is_foot_.resize(v.index() + 1);
      is_foot_[v.index()] = true;
    }
    mesh_.end_batch();
    free_.follow(mesh_.changes());
    made_ = mesh_.changes().made;
    take_over();
  }
}

void Gaps::find_feet(std::span<const TriangleId> made) {
  for (const TriangleId t : made) {
    if (!mesh_.is_triangle(t) || !is_free(t)) continue;
    for (unsigned corner = 0; corner < 3; ++corner) {
      const EdgeId e = Triangulation::edge(t, corner);
      if (is_foot(mesh_.from(e))) continue;
      find_foot(mesh_.point(mesh_.from(e)), Triangulation::next(e), 0);
    }
  }
}

/// Beyond an edge, seen from p, on its left: a wall there, as long as nothing else is nearer: the
/// disc over the way to the foot can only be empty while the perpendicular to each edge between
/// meets that.
void Gaps::find_foot(Point p, EdgeId e, int depth) {
  const Point a = mesh_.point(mesh_.from(e));
  const Point b = mesh_.point(mesh_.to(e));
  if (depth == furthest_look || !has_foot_between(p, a, b)) return;
  const EdgeId twin = beyond(e);
  if (!twin.is_none()) {
    find_foot(p, Triangulation::next(twin), depth + 1);
    find_foot(p, Triangulation::prev(twin), depth + 1);
    return;
  }
  if (!mesh_.is_constrained(e)) return;
  const cdt::Segment& side = mesh_.segment(mesh_.passages(e)[0].segment());
  const Point foot = foot_on(p, mesh_.point(side.from), mesh_.point(side.to));
  if (foot != a && foot != b && foot != p) feet_.push_back(foot);
}

/// Feet from which no gap leads on any more.
void Gaps::remove_idle_feet(std::span<const TriangleId> made) {
  std::vector<VertexId> idle;
  for (const TriangleId t : made) {
    if (!mesh_.is_triangle(t)) continue;
    for (unsigned corner = 0; corner < 3; ++corner) {
      const VertexId v = mesh_.from(Triangulation::edge(t, corner));
      if (!is_foot(v)) continue;
      bool is_idle = true;
      EdgeId e = mesh_.edge(v);
      const EdgeId first = e;
      do {
        is_idle = is_idle && (beyond(e).is_none() || std::isinf(width(e)));
        e = mesh_.rotated(e);
      } while (e != first && is_idle);
      if (is_idle) idle.push_back(v);
    }
  }
  std::ranges::sort(idle);
  idle.erase(std::unique(idle.begin(), idle.end()), idle.end());
  for (const VertexId v : idle) {
    is_foot_[v.index()] = false;
    mesh_.remove(v);
  }
}

/// Sides, widths and corners of what was made.
void Gaps::take_over() {
  beyond_.resize(mesh_.edge_bound());
  widths_.resize(mesh_.edge_bound());
  corners_.resize(mesh_.edge_bound());
  is_around_.resize(mesh_.vertex_bound());
  around_.clear();
  for (const TriangleId t : made_) {
    for (unsigned corner = 0; corner < 3; ++corner) {
      const EdgeId e = Triangulation::edge(t, corner);
      const EdgeId twin = mesh_.twin(e);
      const bool is_open =
          is_free(t) && is_free(Triangulation::triangle(twin)) && !mesh_.is_constrained(e);
      beyond_[e.index()] = is_open ? twin : EdgeId::none();
      beyond_[twin.index()] = is_open ? e : EdgeId::none();
      if (is_open) widths_[e.index()] = widths_[twin.index()] = gap(e);
      corners_[e.index()] = EdgeId::none();
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
        [this](EdgeId e) { return beyond(e); }, corners_);
  }
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
  const Point foot = foot_on(mesh_.point(p), mesh_.point(side.from), mesh_.point(side.to));
  const bool is_its_foot = distance_between(foot, mesh_.point(q)) <= 0x1p-30 * length;
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
