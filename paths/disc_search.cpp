// SPDX-License-Identifier: MIT
#include "paths/disc_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "paths/clearance.h"
#include "paths/ends.h"
#include "paths/exact_distance.h"

namespace loft::paths {

namespace {

/// Directions that differ by less are the same: several roundings.
constexpr double same_direction = 0x1p-49;

/// Angles that rounding does not come to.
constexpr double least_turn_back = 0x1p-30;

/// How far aside from a wall what is seen along it goes.
constexpr double aside = 0x1p-20;

/// On the last way to the goal, within its triangle.
constexpr int most_bends = 3;

[[nodiscard]] Direction way(Point from, Point to) { return {to.x - from.x, to.y - from.y}; }

struct ComesLater {
  template <class Entry>
  bool operator()(const Entry& a, const Entry& b) const {
    return a.estimate != b.estimate ? a.estimate > b.estimate : a.step < b.step;
  }
};

}  // namespace

void DiscSearch::find(const FreeSpace& space, const Query& query, Path& path) {
  path.pieces.clear();
  path.length = std::numeric_limits<double>::infinity();
  expansions_ = 0;
  const bool is_start_clear = is_clear(space, query.from, query.radius, starts_);
  if (!is_start_clear || !is_clear(space, query.to, query.radius, starts_)) {
    path.status = is_start_clear ? Status::goal_blocked : Status::start_blocked;
    return;
  }
  path.status = Status::unreachable;
  space.triangles_at(query.from, starts_);
  space.triangles_at(query.to, goals_);
  if (!space.is_joined(starts_, goals_)) return;
  begin(space, query);
  for (const TriangleId t : starts_) start(t);
  while (!heap_.empty() && heap_.front().estimate < length_) {
    if (expansions_ >= query.most_expansions) {
      path.status = Status::gave_up;
      return;
    }
    const Step step = steps_[heap_.front().step];
    std::ranges::pop_heap(heap_, ComesLater());
    heap_.pop_back();
    if (step.is_bend)
      expand(step.bend);
    else
      expand(step.interval);
  }
  if (last_ != none) {
    path.status = Status::found;
    put_together(path);
  } else if (is_joined()) {
    path.status = Status::gave_up;
  }
}

/// Whether triangles lead from the start to the goal.
bool DiscSearch::is_joined() const {
  std::vector<bool> is_reached(mesh_->triangle_bound());
  std::vector<TriangleId> front(starts_);
  for (const TriangleId t : front) is_reached[t.index()] = true;
  while (!front.empty()) {
    const TriangleId t = front.back();
    front.pop_back();
    if (is_goal(t)) return true;
    for (unsigned corner = 0; corner < 3; ++corner) {
      const EdgeId entry = beyond(Triangulation::edge(t, corner));
      if (entry.is_none() || is_reached[entry.index() / 3]) continue;
      is_reached[entry.index() / 3] = true;
      front.push_back(Triangulation::triangle(entry));
    }
  }
  return false;
}

void DiscSearch::begin(const FreeSpace& space, const Query& query) {
  gaps_ = space.gaps();
  mesh_ = &gaps_->mesh();
  goal_ = query.to;
  radius_ = query.radius;
  length_ = std::numeric_limits<double>::infinity();
  last_ = none;
  names_ = 0;
  roots_.assign(1, {.circle = {query.from, 0}, .in = {}});
  steps_.clear();
  heap_.clear();
  if (best_.size() < 2 * mesh_->edge_bound()) best_.resize(2 * mesh_->edge_bound());
  if (++search_ == 0) {
    std::ranges::fill(best_, Best());
    search_ = 1;
  }
  find_triangles(query.from, starts_);
  find_triangles(query.to, goals_);
}

/// Those that a point is in or on the side of, in an order that coordinates alone decide.
void DiscSearch::find_triangles(Point p, std::vector<TriangleId>& found) const {
  found.clear();
  const cdt::Location place = mesh_->locate(p);
  const auto add = [&](EdgeId e) {
    if (gaps_->is_free(Triangulation::triangle(e))) found.push_back(Triangulation::triangle(e));
  };
  if (place.kind == cdt::Location::Kind::triangle) add(place.edge);
  if (place.kind != cdt::Location::Kind::edge) return;
  const EdgeId twin = mesh_->twin(place.edge);
  const bool is_upward = from(place.edge) < from(twin);
  add(is_upward ? place.edge : twin);
  add(is_upward ? twin : place.edge);
}

void DiscSearch::start(TriangleId t) {
  const EdgeId first = first_edge(*mesh_, t);
  if (is_goal(t)) {
    const Direction there = tangent(roots_[0].circle, {goal_, 0}).along;
    const std::array corners{corner_beside(there, first),
                             corner_beside(there, Triangulation::next(first)),
                             corner_beside(there, Triangulation::prev(first))};
    see_goal(0, corners, nullptr, nullptr);
  }
  EdgeId e = first;
  do {
    start_through(e);
    e = Triangulation::next(e);
  } while (e != first);
}

/// From the start out over a side of its triangle. The third corner may be in the way, too: then
/// the path bends around that first.
void DiscSearch::start_through(EdgeId e) {
  const EdgeId entry = beyond(e);
  if (entry.is_none() ||
      cdt::orient(from(e), from(Triangulation::next(e)), roots_[0].circle.centre) <= 0)
    return;
  const EdgeId at_left = Triangulation::next(e);
  const EdgeId at_third = Triangulation::prev(e);
  const Interval seen{.edge = entry,
                      .root = 0,
                      .left = left_bound(roots_[0], at_left),
                      .right = right_bound(roots_[0], e)};
  Interval rest = seen;
  // Within a quarter of a turn beyond an end of the view, and reaching into it.
  const auto is_in_the_way = [&](const Bound& third, const Bound& end, double side) {
    const Direction to_end = way(roots_[0].circle.centre, end.circle.centre);
    const Direction to_third = way(roots_[0].circle.centre, third.circle.centre);
    return side * cross(to_end, to_third) > 0 && dot(to_end, to_third) > 0 &&
           side * cross(end.along, third.along) < 0;
  };
  const Bound third_left = left_bound(roots_[0], at_third);
  const Bound third_right = right_bound(roots_[0], at_third);
  const auto bend = [&](const Bound& third) {
    const auto root = static_cast<std::uint32_t>(roots_.size());
    const Tangent there = tangent(roots_[0].circle, third.circle);
    if (!is_way_clear(0, there, third.circle)) return;
    roots_.push_back({third.circle, there.along, there.length, 0, none, names_++});
    Interval turned = seen;
    turned.root = root;
    turned.left = left_bound(roots_[root], at_left);
    turned.right = right_bound(roots_[root], e);
    Bound& near = third.circle.radius > 0 ? turned.right : turned.left;
    const double side = third.circle.radius > 0 ? 1 : -1;
    if (side * cross(near.along, there.along) > 0) near = {near.circle, there.along, false};
    push(turned);
  };
  if (third_left.circle.radius > 0 && is_in_the_way(third_left, seen.left, 1)) {
    rest.left = {third_left.circle, third_left.along, false};
    bend(third_left);
  } else if (third_right.circle.radius < 0 && is_in_the_way(third_right, seen.right, -1)) {
    rest.right = {third_right.circle, third_right.along, false};
    bend(third_right);
  }
  const double room = cross(rest.right.along, rest.left.along);
  if (room >= -same_direction || reaches(roots_[0], rest.left, -1, rest.right.circle.centre) ||
      reaches(roots_[0], rest.right, 1, rest.left.circle.centre))
    push(rest);
  if (room > same_direction) return;
  // What the sides of the view hide of each other.
  if (rest.left.is_at_end) turn_at(entry, 0, rest.left.circle);
  if (rest.right.is_at_end) turn_at(Triangulation::next(entry), 0, rest.right.circle);
}

/// Whether a path along a bound touches its circle before it would come to another.
bool DiscSearch::comes_first(const Root& root, const Bound& bound, const Circle& other) const {
  const Point start = Tangent{bound.along, 0}.touch(root.circle);
  return dot(bound.along, way(start, other.centre)) >= tangent(root.circle, bound.circle).length;
}

/// Whether a bound, crossed by another one at a point to the left of it, side 1, or to the right,
/// -1, still lets a path through: that bends before it comes there, at what is still to be seen, or
/// ends.
bool DiscSearch::reaches(const Root& root, const Bound& bound, double side, Point other) const {
  if (bound.is_at_end && bound.circle.radius == 0) return true;
  const Point start = Tangent{bound.along, 0}.touch(root.circle);
  return side * cross(bound.along, way(start, other)) > 0;
}

bool DiscSearch::is_goal(TriangleId t) const {
  return std::ranges::find(goals_, t) != goals_.end();
}

/// Whether a path would leave a circle before it comes there.
bool DiscSearch::turns_back(const Root& root, Direction out) {
  const double side = root.circle.radius > 0 ? 1 : -1;
  return root.circle.radius != 0 && dot(root.in, out) > 0 &&
         side * cross(root.in, out) < -least_turn_back;
}

double DiscSearch::length_to(const Root& root, Direction out) const {
  if (root.circle.radius == 0) return root.length;
  return root.length + std::max(0.0, root.circle.radius * angle_between(root.in, out));
}

/// A corner of the goal's triangle that nothing has been said of.
DiscSearch::Corner DiscSearch::corner_beside(Direction way_to_goal, EdgeId e) const {
  const bool is_left = cross(way_to_goal, way(goal_, from(e))) > 0;
  return {is_left ? on_left(e) : on_right(e), is_left ? 1.0 : -1.0, false};
}

/// The goal is in a triangle that a root sees between two directions, or from one, or one, on.
/// `corners`: of the triangle.
void DiscSearch::see_goal(std::uint32_t root, std::span<const Corner> corners,
                          const Direction* left, const Direction* right) {
  const Direction there = tangent(roots_[root].circle, {goal_, 0}).along;
  if (left != nullptr && cross(*left, there) > same_direction) return;
  if (right != nullptr && cross(*right, there) < -same_direction) return;
  pull_to_goal(root, corners, 0);
}

/// Straight to the goal, or around what is in the way.
void DiscSearch::pull_to_goal(std::uint32_t root, std::span<const Corner> corners, int depth) {
  const Root from = roots_[root];
  const Tangent there = tangent(from.circle, {goal_, 0});
  double worst = -0x1p-45 * radius_;
  const Corner* in_the_way = nullptr;
  for (const Corner& corner : corners) {
    if (corner.circle.centre == from.circle.centre) continue;
    const Direction to_corner = way(goal_, corner.circle.centre);
    const double beside = corner.side * cross(there.along, to_corner);
    const double back = -dot(there.along, to_corner);
    const bool is_beside = back > 0 && back < there.length && corner.circle.radius != 0;
    if (!is_beside && !(corner.is_passed && beside < 0)) continue;
    if (beside - radius_ >= worst) continue;
    worst = beside - radius_;
    in_the_way = &corner;
  }
  if (in_the_way == nullptr) return finish(root, there);
  if (depth == most_bends || in_the_way->circle.radius == 0) return;
  const Tangent first = tangent(from.circle, in_the_way->circle);
  if (!is_way_clear(root, first, in_the_way->circle)) return;
  const double length = length_to(from, first.along) + first.length;
  const auto bend = static_cast<std::uint32_t>(roots_.size());
  roots_.push_back({in_the_way->circle, first.along, length, root, none, names_++});
  pull_to_goal(bend, corners, depth + 1);
}

/// Tangents to circles that are not seen yet may lead through what is between: these are no way.
bool DiscSearch::is_way_clear(std::uint32_t root, const Tangent& way, const Circle& to) {
  return sweep_.is_clear(*gaps_, way.touch(roots_[root].circle), way.touch(to), radius_,
                         Triangulation::edge(starts_.front()));
}

void DiscSearch::finish(std::uint32_t root, const Tangent& last) {
  const double length = length_to(roots_[root], last.along) + last.length;
  if (length >= length_ || !is_way_clear(root, last, {goal_, 0})) return;
  length_ = length;
  last_ = root;
}

void DiscSearch::expand(const Interval& interval) {
  ++expansions_;
  const EdgeId e = interval.edge;
  const TriangleId t = Triangulation::triangle(e);
  const EdgeId at_right = Triangulation::next(e);
  const EdgeId at_apex = Triangulation::prev(e);
  const Root root = roots_[interval.root];
  if (root.key != none) {
    const Best& best = best_[root.key];
    if (best.name != root.name && covers(best, root)) return;
  }
  if (is_goal(t)) {
    const Tangent straight = tangent(root.circle, {goal_, 0});
    const Direction there = straight.along;
    // A circle may reach over the edge: what leaves it there need not cross that.
    const Point start = straight.touch(root.circle);
    const bool crosses = cross(way(from(e), from(at_right)), way(from(e), start)) < 0;
    const std::array corners{left_corner(e, crosses), right_corner(at_right, crosses),
                             corner_beside(there, at_apex)};
    see_goal(interval.root, corners, interval.left.is_at_end ? nullptr : &interval.left.along,
             interval.right.is_at_end ? nullptr : &interval.right.along);
  }

  const Bound apex_left = left_bound(root, at_apex);
  const Bound apex_right = right_bound(root, at_apex);
  // Where bounds fall together both may be: what is seen, and what is beyond.
  const double left_room = -cross(interval.left.along, apex_right.along);
  const double right_room = cross(interval.right.along, apex_left.along);
  const bool sees_left =
      left_room >= -same_direction || reaches(root, interval.left, -1, from(at_apex));
  const bool sees_right =
      right_room >= -same_direction || reaches(root, interval.right, 1, from(at_apex));
  // What is between the end of the view and the apex is seen from either of them.
  if (left_room <= same_direction && interval.left.is_at_end) {
    turn_at(e, interval.root, interval.left.circle);
    if (const EdgeId left = beyond(at_apex); !left.is_none())
      turn_at(Triangulation::next(left), interval.root, apex_right.circle);
  }
  if (right_room <= same_direction && interval.right.is_at_end) {
    turn_at(at_right, interval.root, interval.right.circle);
    if (const EdgeId right = beyond(at_right); !right.is_none())
      turn_at(right, interval.root, apex_left.circle);
  }

  if (const EdgeId left = beyond(at_apex); sees_left && !left.is_none()) {
    Interval on{left, interval.root, interval.left, interval.right};
    if (cross(interval.right.along, apex_right.along) >= 0)
      on.right = apex_right;
    else
      on.right.is_at_end = false;
    push(on);
  }
  if (const EdgeId right = beyond(at_right); sees_right && !right.is_none()) {
    Interval on{right, interval.root, interval.left, interval.right};
    if (cross(interval.left.along, apex_left.along) <= 0)
      on.left = apex_left;
    else
      on.left.is_at_end = false;
    push(on);
  }
}

/// The part around from(e) that a disc can go through, and the side on which it bends there.
std::uint32_t DiscSearch::key_of(EdgeId e, bool is_left) const {
  const EdgeId first = e;
  for (EdgeId twin = beyond(Triangulation::prev(e)); !twin.is_none() && twin != first;
       twin = beyond(Triangulation::prev(e)))
    e = twin;
  return 2 * e.index() + (is_left ? 1 : 0);
}

bool DiscSearch::covers(const Best& best, const Root& other) const {
  return best.length + radius_ * std::abs(angle_between(best.in, other.in)) <= other.length;
}

/// A path comes to a circle around from(e), to bend around it in the triangle left of e.
void DiscSearch::turn_at(EdgeId e, std::uint32_t root, const Circle& circle) {
  if (gaps_->corner(e).is_none()) return;
  Tangent there = tangent(roots_[root].circle, circle);
  // A circle that would be left before it is come to is not on the way.
  while (turns_back(roots_[root], there.along)) {
    root = roots_[root].before;
    there = tangent(roots_[root].circle, circle);
  }
  if (!is_way_clear(root, there, circle)) return;
  const Root next{circle,
                  there.along,
                  length_to(roots_[root], there.along) + there.length,
                  root,
                  key_of(e, circle.radius > 0),
                  names_++};
  Best& best = best_[next.key];
  if (best.search == search_ && covers(best, next)) return;
  if (best.search != search_ || next.length < best.length)
    best = {next.length, next.in, next.name, search_};
  const double estimate = next.length + length_of(way(there.touch(circle), goal_)) * (1 - 0x1p-48);
  if (estimate >= length_) return;
  push(estimate, {.interval = {}, .bend = {e, next}, .is_bend = true});
}

void DiscSearch::expand(const Bend& bend) {
  ++expansions_;
  const Best& best = best_[bend.root.key];
  if (best.name != bend.root.name && covers(best, bend.root)) return;
  const auto number = static_cast<std::uint32_t>(roots_.size());
  roots_.push_back(bend.root);
  const Root root = bend.root;
  const bool is_left = root.circle.radius > 0;
  const double side = is_left ? 1 : -1;
  // The tangent along which it came, or to what is passed on the other side, whichever bounds more.
  Bound near{root.circle, root.in, false};
  EdgeId e = bend.edge;
  for (bool has_begun = false;;) {
    const EdgeId at_right = Triangulation::next(e);
    const EdgeId at_left = Triangulation::prev(e);
    const EdgeId at_near = is_left ? at_right : at_left;
    // Up to the way on which it came, and no more than half a turn beyond.
    const auto is_beyond = [&](EdgeId at) {
      return side * cross(root.in, way(root.circle.centre, from(at))) > 0;
    };
    if (has_begun && !is_beyond(at_near)) return;
    has_begun = has_begun || is_beyond(is_left ? at_left : at_right);
    const Bound next = is_left ? right_bound(root, at_near) : left_bound(root, at_near);
    if (side * cross(near.along, next.along) > 0)
      near = next;
    else
      near.is_at_end = false;
    Bound far = is_left ? left_bound(root, at_left) : right_bound(root, at_right);
    const EdgeId twin = beyond(is_left ? at_left : e);
    // Along a wall from here, not through it, and a bit aside: corners on it come first.
    if (far.circle.radius == 0 && twin.is_none()) {
      const Direction along = tangent(root.circle, {far.circle.centre, root.circle.radius}).along;
      far.along = {along.x - side * aside * along.y, along.y + side * aside * along.x};
    }
    if (is_goal(Triangulation::triangle(e))) {
      const Direction* const limit = near.is_at_end ? nullptr : &near.along;
      see_goal(number, std::array{left_corner(at_left, false), right_corner(at_right, false)},
               is_left ? nullptr : limit, is_left ? limit : nullptr);
    }
    const EdgeId entry = beyond(at_right);
    const double room = side * cross(near.along, far.along);
    if ((room >= -same_direction || reaches(root, near, side, far.circle.centre)) &&
        !entry.is_none())
      push(is_left ? Interval{entry, number, far, near} : Interval{entry, number, near, far});
    if (room <= same_direction && near.is_at_end) {
      turn_at(at_near, number, near.circle);
      if (!entry.is_none())
        turn_at(is_left ? entry : Triangulation::next(entry), number, far.circle);
    }
    if (twin.is_none()) return;
    e = is_left ? twin : Triangulation::next(twin);
    if (e == bend.edge) return;
  }
}

void DiscSearch::push(const Interval& interval) {
  if (!interval.left.is_at_end && !interval.right.is_at_end &&
      cross(interval.right.along, interval.left.along) < -same_direction)
    return;
  const double least = estimate(interval);
  if (least < length_) push(least, {.interval = interval, .bend = {}, .is_bend = false});
}

void DiscSearch::push(double estimate, const Step& step) {
  heap_.push_back({estimate, static_cast<std::uint32_t>(steps_.size())});
  steps_.push_back(step);
  std::ranges::push_heap(heap_, ComesLater());
}

double DiscSearch::estimate(const Interval& interval) const {
  const Point a = from(interval.edge);
  const Point b = from(Triangulation::next(interval.edge));
  const Direction edge = way(a, b);
  const Root& root = roots_[interval.root];
  Point goal = goal_;
  if (const double height = cross(edge, way(a, goal)); height < 0) {
    const double by = 2 * height / dot(edge, edge);
    goal = {goal.x + by * edge.y, goal.y - by * edge.x};
  }
  const Tangent there = tangent(root.circle, {goal, 0});
  // A circle at the end does not matter if the goal comes before it.
  const auto is_bound = [&](const Bound& bound, double side) {
    return side * cross(bound.along, there.along) > 0 &&
           !(bound.is_at_end && !comes_first(root, bound, {goal, 0}));
  };
  if (is_bound(interval.left, 1)) return through_bound(root, interval.left, a, b, goal);
  if (is_bound(interval.right, -1)) return through_bound(root, interval.right, a, b, goal);
  return (length_to(root, there.along) + there.length) * (1 - 0x1p-48);
}

/// The length of what goes along a bound to the edge, or to the circle at its end, and from there
/// straight to the goal.
double DiscSearch::through_bound(const Root& root, const Bound& bound, Point a, Point b,
                                 Point goal) const {
  const Point start = Tangent{bound.along, 0}.touch(root.circle);
  double t = 0;
  if (bound.is_at_end) {
    t = tangent(root.circle, bound.circle).length;
  } else {
    const Direction edge = way(a, b);
    const Direction to_edge = way(start, a);
    const double sine = cross(bound.along, edge);
    t = cross(to_edge, edge) / sine;
    t -= 0x1p-49 * (std::abs(to_edge.x * edge.y) + std::abs(to_edge.y * edge.x)) / std::abs(sine);
    t = std::isfinite(t) && t > 0 ? t : 0;
  }
  const Point end{start.x + t * bound.along.x, start.y + t * bound.along.y};
  return (length_to(root, bound.along) + t + length_of(way(end, goal))) * (1 - 0x1p-48);
}

void DiscSearch::put_together(Path& path) const {
  path.length = length_;
  Circle to{goal_, 0};
  Point end = goal_;
  for (std::uint32_t r = last_; r != none; r = roots_[r].before) {
    const Root& root = roots_[r];
    const Tangent straight = tangent(root.circle, to);
    const Point start = straight.touch(root.circle);
    if (start != end) path.pieces.push_back({.from = start, .to = end});
    end = start;
    if (root.circle.radius != 0) {
      const Point in = Tangent{root.in, 0}.touch(root.circle);
      if (in != end)
        path.pieces.push_back({.from = in,
                               .to = end,
                               .turn = root.circle.radius > 0 ? Turn::left : Turn::right,
                               .centre = root.circle.centre});
      end = in;
    }
    to = root.circle;
  }
  std::ranges::reverse(path.pieces);
}

}  // namespace loft::paths
