// SPDX-License-Identifier: MIT
#include "paths/shortest.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "cdt/predicates.h"
#include "paths/clearance.h"
#include "paths/directions.h"
#include "paths/distance.h"
#include "paths/expect_followed.h"
#include "paths/visible.h"

namespace loft::paths {

using cdt::orient;

namespace {

[[nodiscard]] double cross_of(double ax, double ay, double bx, double by) {
  return ax * by - ay * bx;
}

/// The mirror image of p in the line ab.
[[nodiscard]] Point mirrored(Point a, Point b, Point p) {
  const double x = b.x - a.x;
  const double y = b.y - a.y;
  const double by = 2 * cross_of(x, y, p.x - a.x, p.y - a.y) / (x * x + y * y);
  return {p.x + by * y, p.y - by * x};
}

/// The last is first of those with the same estimate.
struct IsLater {
  template <class Entry>
  bool operator()(const Entry& a, const Entry& b) const {
    return a.estimate != b.estimate ? a.estimate > b.estimate : a.step < b.step;
  }
};

}  // namespace

void Workspace::find(const FreeSpace& space, const Query& query, Path& path) {
  expect_followed(space);
  if (!(query.radius >= 0 && std::isfinite(query.radius)))
    throw std::invalid_argument("paths: the radius is not 0 or more, and finite");
  if (query.radius > 0) {
    (void)gaps_of(space);
    disc_.find(space, query, path);
    expansions_ = disc_.expansions();
    return;
  }
  path.pieces.clear();
  path.length = std::numeric_limits<double>::infinity();
  expansions_ = 0;
  path.status = ends_.find(space, query.from, query.to);
  if (path.status != Status::found) return;
  begin(space, query);
  for (const TriangleId t : ends_.starts) start(t);
  while (!heap_.empty() && heap_.front().estimate < length_) {
    if (expansions_ >= query.most_expansions) break;
    const Step step = steps_[heap_.front().step];
    std::ranges::pop_heap(heap_, IsLater());
    heap_.pop_back();
    if (step.is_bend)
      expand(step.bend);
    else
      expand(step.interval);
  }
  dead_ends_.end(space, expansions_);
  const bool gave_up = !heap_.empty() && heap_.front().estimate < length_;
  path.status = gave_up ? Status::gave_up : Status::found;
  if (gave_up) return;
  put_together(path);
  straighten(query, path);
}

/// A turn of less than rounding is none, if the goal is seen from the start.
void Workspace::straighten(const Query& query, Path& path) const {
  const double straight = distance_between(query.from, query.to);
  if (path.pieces.size() < 2 || path.length > straight * (1 + 0x1p-50)) return;
  if (!sees(*space_, query.from, query.to)) return;
  path.length = straight;
  path.pieces.assign(1, {.from = query.from, .to = query.to});
}

void Workspace::begin(const FreeSpace& space, const Query& query) {
  space_ = &space;
  mesh_ = &space.mesh();
  goal_ = query.to;
  length_ = std::numeric_limits<double>::infinity();
  last_ = none;
  dead_ends_.begin(space, ends_.goals);
  roots_.assign(1, {.place = query.from, .corner = {}});
  steps_.clear();
  heap_.clear();
  if (best_.size() < mesh_->edge_bound()) best_.resize(mesh_->edge_bound());
  if (++search_ == 0) {
    std::ranges::fill(best_, Best());
    search_ = 1;
  }
}

/// All that is seen of a triangle from a start in it or on its border.
void Workspace::start(TriangleId t) {
  if (ends_.is_goal(t)) see_goal(0);
  const EdgeId first = first_edge(*mesh_, t);
  EdgeId e = first;
  do {
    const Point left = mesh_->point(mesh_->to(e));
    const Point right = mesh_->point(mesh_->from(e));
    const EdgeId entry = beyond(e);
    if (!entry.is_none() && orient(right, left, roots_[0].place) > 0)
      push(Interval{.edge = entry,
                    .root = 0,
                    .left = {.to = left, .is_at_end = true},
                    .right = {.to = right, .is_at_end = true}});
    e = Triangulation::next(e);
  } while (e != first);
}

void Workspace::see_goal(std::uint32_t root) {
  const double length = roots_[root].length + distance_between(roots_[root].place, goal_);
  if (length >= length_) return;
  length_ = length;
  last_ = root;
}

/// On which side of a ray a point is, seen from where the ray starts: +1 left, -1 right.
int Workspace::side_of(const Interval& interval, const Ray& ray, Point p) const {
  const Root& root = roots_[interval.root];
  return ray.is_extension ? orient(roots_[root.before].place, root.place, p)
                          : orient(root.place, ray.to, p);
}

void Workspace::expand(Interval interval) {
  for (;;) {
    ++expansions_;
    const EdgeId e = interval.edge;
    const TriangleId t = Triangulation::triangle(e);
    const Root& root = roots_[interval.root];
    if (!root.corner.is_none() && best_[root.corner.index()].length < root.length) return;
    if (ends_.is_goal(t) && side_of(interval, interval.left, goal_) <= 0 &&
        side_of(interval, interval.right, goal_) >= 0)
      see_goal(interval.root);

    const Point apex = mesh_->point(mesh_->apex(e));
    const int left_side = side_of(interval, interval.left, apex);
    const int right_side = side_of(interval, interval.right, apex);
    const EdgeId left = beyond(Triangulation::prev(e));   // the left end to the apex
    const EdgeId right = beyond(Triangulation::next(e));  // the apex to the right end
    if (interval.left.is_at_end && !space_->corner(e).is_none()) {
      if (left_side > 0)
        turn_at(space_->corner(e), interval, Side::left, e, true);
      else if (left_side == 0 && !left.is_none())
        turn_at(space_->corner(e), interval, Side::left, left, false);
    }
    const EdgeId at_right = Triangulation::next(e);
    if (interval.right.is_at_end && !space_->corner(at_right).is_none()) {
      if (right_side < 0)
        turn_at(space_->corner(at_right), interval, Side::right, at_right, true);
      else if (right_side == 0 && !right.is_none())
        turn_at(space_->corner(at_right), interval, Side::right, Triangulation::next(right), false);
    }

    const bool goes_left = left_side < 0 && !left.is_none();
    const bool goes_right = right_side > 0 && !right.is_none();
    Interval on_left = interval;
    on_left.edge = left;
    if (right_side >= 0)
      on_left.right = {.to = apex, .is_at_end = true};
    else
      on_left.right.is_at_end = false;
    Interval on_right = interval;
    on_right.edge = right;
    if (left_side <= 0)
      on_right.left = {.to = apex, .is_at_end = true};
    else
      on_right.left.is_at_end = false;
    if (goes_left && goes_right) push(on_left);
    if (!goes_left && !goes_right) return;
    interval = goes_right ? on_right : on_left;
    const double next = estimate(interval);
    if (next >= length_) return;
    if (!heap_.empty() && heap_.front().estimate < next)
      return push(next, {.interval = interval, .bend = {}, .is_bend = false});
  }
}

/// A path comes to an end of what is seen of an edge, and may go on around it.
void Workspace::turn_at(EdgeId corner, const Interval& interval, Side side, EdgeId fan,
                        bool is_cut) {
  const Root& root = roots_[interval.root];
  const Point place = side == Side::left ? interval.left.to : interval.right.to;
  const double length = root.length + distance_between(root.place, place);
  Best& best = best_[corner.index()];
  const auto flag = static_cast<std::uint8_t>(side == Side::left ? 1 : 2);
  if (best.search == search_ && best.length <= length) {
    if (best.length < length || (best.sides & flag) != 0) return;
    best.sides |= flag;
  } else {
    best = {length, search_, flag};
  }
  const double estimate = length + distance_between(place, goal_);
  if (estimate >= length_) return;
  push(estimate,
       {.interval = {},
        .bend =
            {.edge = fan, .root = interval.root, .side = side, .is_cut = is_cut, .length = length},
        .is_bend = true});
}

/// Everything that is seen from a corner on the way around it.
void Workspace::expand(const Bend& bend) {
  ++expansions_;
  const EdgeId corner = space_->corner(bend.edge);
  if (best_[corner.index()].length < bend.length) return;
  const Point from = roots_[bend.root].place;
  const Point here = mesh_->point(mesh_->from(bend.edge));
  const auto root = static_cast<std::uint32_t>(roots_.size());
  roots_.push_back({here, bend.length, bend.root, corner});

  // The triangles around the corner, each by its edge from there, from the ray that came here on.
  const bool is_left = bend.side == Side::left;
  bool is_cut = bend.is_cut;
  EdgeId e = bend.edge;
  for (;;) {
    const Point right = mesh_->point(mesh_->to(e));
    const Point left = mesh_->point(mesh_->apex(e));
    if (!is_cut) {
      const int side = orient(from, here, is_left ? right : left);
      if (is_left ? side < 0 : side > 0) return;  // more than half a turn
    }
    if (ends_.is_goal(Triangulation::triangle(e))) {
      const int side = is_cut ? orient(from, here, goal_) : 0;
      if (is_left ? side >= 0 : side <= 0) see_goal(root);
    }
    const EdgeId entry = beyond(Triangulation::next(e));
    if (!entry.is_none()) {
      Interval seen{.edge = entry,
                    .root = root,
                    .left = {.to = left, .is_at_end = true},
                    .right = {.to = right, .is_at_end = true}};
      if (is_cut) (is_left ? seen.right : seen.left) = {.to = here, .is_extension = true};
      push(seen);
    }
    is_cut = false;
    const EdgeId twin = beyond(is_left ? Triangulation::prev(e) : e);
    if (twin.is_none()) return;
    e = is_left ? twin : Triangulation::next(twin);
    if (e == bend.edge) return;
  }
}

void Workspace::push(const Interval& interval) {
  const double least = estimate(interval);
  if (least < length_) push(least, {.interval = interval, .bend = {}, .is_bend = false});
}

void Workspace::push(double estimate, const Step& step) {
  heap_.push_back({estimate, static_cast<std::uint32_t>(steps_.size())});
  steps_.push_back(step);
  std::ranges::push_heap(heap_, IsLater());
}

/// No path from the root through what it sees of the edge is shorter. A goal on the root's side of
/// the edge counts as its mirror image.
double Workspace::estimate(const Interval& interval) const {
  const Point a = mesh_->point(mesh_->from(interval.edge));
  const Point b = mesh_->point(mesh_->to(interval.edge));
  const Root& root = roots_[interval.root];
  const bool is_beyond = cross_of(b.x - a.x, b.y - a.y, goal_.x - a.x, goal_.y - a.y) >= 0;
  const Point goal = is_beyond ? goal_ : mirrored(a, b, goal_);
  const double x = goal.x - root.place.x;
  const double y = goal.y - root.place.y;
  const auto direction = [&](const Ray& ray) {
    const Point from = ray.is_extension ? roots_[root.before].place : root.place;
    return Point{ray.to.x - from.x, ray.to.y - from.y};
  };
  if (const Point left = direction(interval.left); cross_of(left.x, left.y, x, y) > 0)
    return through_end(interval, interval.left, left, a, b, goal);
  if (const Point right = direction(interval.right); cross_of(right.x, right.y, x, y) < 0)
    return through_end(interval, interval.right, right, a, b, goal);
  return root.length + distance_between(root.place, goal);
}

/// The length through the end of what is seen, on the ray from the root in direction `along`; not
/// more, whatever is rounded.
double Workspace::through_end(const Interval& interval, const Ray& ray, Point along, Point a,
                              Point b, Point goal) const {
  const Root& root = roots_[interval.root];
  if (ray.is_at_end)
    return root.length + distance_between(root.place, ray.to) + distance_between(ray.to, goal);
  const double x = b.x - a.x;
  const double y = b.y - a.y;
  const double right = (a.x - root.place.x) * y;
  const double left = (a.y - root.place.y) * x;
  const double sine = cross_of(along.x, along.y, x, y);
  double t = (right - left) / sine;
  t -= 0x1p-50 * (std::abs(right) + std::abs(left)) / std::abs(sine);
  t = std::isfinite(t) && t > 0 ? t : 0;
  const Point end{root.place.x + t * along.x, root.place.y + t * along.y};
  return root.length + t * length_of({along.x, along.y}) + distance_between(end, goal);
}

void Workspace::put_together(Path& path) const {
  path.length = length_;
  Point to = goal_;
  for (std::uint32_t r = last_; r != none; r = roots_[r].before) {
    const Point from = roots_[r].place;
    if (from == to) continue;
    // Three in line are no turn.
    if (!path.pieces.empty() && orient(from, path.pieces.back().from, path.pieces.back().to) == 0)
      path.pieces.back().from = from;
    else
      path.pieces.push_back({.from = from, .to = to});
    to = from;
  }
  std::ranges::reverse(path.pieces);
}

Path shortest_path(const FreeSpace& space, const Query& query) {
  Workspace workspace;
  Path path;
  workspace.find(space, query, path);
  return path;
}

}  // namespace loft::paths
