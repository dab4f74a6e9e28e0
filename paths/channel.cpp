// SPDX-License-Identifier: MIT
#include "paths/channel.h"

#include <algorithm>
#include <utility>

#include "cdt/predicates.h"
#include "paths/directions.h"
#include "paths/distance.h"
#include "paths/expect_followed.h"

namespace loft::paths {

namespace {

[[nodiscard]] Direction towards(Point from, Point to) { return {to.x - from.x, to.y - from.y}; }

/// The mirror image of p in the line ab.
[[nodiscard]] Point reflected(Point a, Point b, Point p) {
  const Direction along = towards(a, b);
  const double by = 2 * cross(along, towards(a, p)) / dot(along, along);
  return {p.x + by * along.y, p.y - by * along.x};
}

/// The first found is first of those with the same estimate.
struct IsLessPromising {
  template <class Entry>
  bool operator()(const Entry& a, const Entry& b) const {
    return a.estimate != b.estimate ? a.estimate > b.estimate : a.entrance > b.entrance;
  }
};

}  // namespace

void ChannelSearch::find(const FreeSpace& space, Point from, Point to, Channel& channel) {
  expect_followed(space);
  channel.from = from;
  channel.to = to;
  channel.triangles.clear();
  channel.portals.clear();
  expansions_ = 0;
  channel.status = ends_.find(space, from, to);
  if (channel.status != Status::found) return;
  if (const auto both =
          std::ranges::find_if(ends_.starts, [&](TriangleId t) { return ends_.is_goal(t); });
      both != ends_.starts.end()) {
    channel.triangles.push_back(*both);
    return;
  }
  begin(space, from, to);
  for (const TriangleId t : ends_.starts) start(t);
  while (last_ == none) expand(pop());
  dead_ends_.end(space, expansions_);
  put_together(channel);
}

void ChannelSearch::begin(const FreeSpace& space, Point from, Point to) {
  space_ = &space;
  mesh_ = &space.mesh();
  to_ = to;
  last_ = none;
  dead_ends_.begin(space, ends_.goals);
  turnings_.assign(1, {.place = from});
  entrances_.clear();
  heap_.clear();
  next_ = {};
  if (best_.size() < mesh_->edge_bound()) best_.resize(mesh_->edge_bound());
  if (positions_.size() < mesh_->triangle_bound()) positions_.resize(mesh_->triangle_bound());
  if (++search_ == 0) {
    std::ranges::fill(best_, Best());
    search_ = 1;
  }
}

/// Over the sides of a triangle that the start is in, but for those that it is on.
void ChannelSearch::start(TriangleId t) {
  const EdgeId first = first_edge(*mesh_, t);
  EdgeId e = first;
  do {
    const Point left = mesh_->point(mesh_->to(e));
    const Point right = mesh_->point(mesh_->from(e));
    const EdgeId entry = beyond(e);
    if (!entry.is_none() && cdt::orient(right, left, turnings_[0].place) > 0)
      enter(
          {.edge = entry, .root = 0, .left = add_turning(left, 0), .right = add_turning(right, 0)});
    e = Triangulation::next(e);
  } while (e != first);
}

std::uint32_t ChannelSearch::add_turning(Point place, std::uint32_t before) {
  const Turning& last = turnings_[before];
  turnings_.push_back({place, last.length + distance_between(last.place, place), before});
  return static_cast<std::uint32_t>(turnings_.size() - 1);
}

/// From a triangle over its two other sides.
void ChannelSearch::expand(std::uint32_t index) {
  const Entrance here = entrances_[index];
  const EdgeId e = here.edge;
  const Best& best = best_[e.index()];
  if (best.to_left < turnings_[here.left].length && best.to_right < turnings_[here.right].length)
    return;
  ++expansions_;
  if (ends_.is_goal(Triangulation::triangle(e))) {
    last_ = index;
    return;
  }
  const EdgeId left = beyond(Triangulation::prev(e));
  const EdgeId right = beyond(Triangulation::next(e));
  if (left.is_none() && right.is_none()) return;
  const Point apex = mesh_->point(mesh_->apex(e));
  const auto [turning, chain] = last_turn(here, apex);
  const std::uint32_t end = add_turning(apex, turning);
  Entrance on_left{
      .edge = left, .before = index, .root = here.root, .left = here.left, .right = end};
  Entrance on_right{
      .edge = right, .before = index, .root = here.root, .left = end, .right = here.right};
  if (chain == Chain::left) on_left.root = turning;
  if (chain == Chain::right) on_right.root = turning;
  if (!left.is_none()) enter(on_left);
  if (!right.is_none()) enter(on_right);
}

/// Unless there is one through which each end of the edge is at least as near.
void ChannelSearch::enter(const Entrance& entrance) {
  const double to_left = turnings_[entrance.left].length;
  const double to_right = turnings_[entrance.right].length;
  Best& best = best_[entrance.edge.index()];
  if (best.search != search_) {
    best = {to_left, to_right, search_};
  } else {
    if (best.to_left <= to_left && best.to_right <= to_right) return;
    best.to_left = std::min(best.to_left, to_left);
    best.to_right = std::min(best.to_right, to_right);
  }
  push({estimate(entrance), static_cast<std::uint32_t>(entrances_.size())});
  entrances_.push_back(entrance);
}

void ChannelSearch::push(Entry entry) {
  if (next_.entrance != none) {
    if (IsLessPromising()(next_, entry)) std::swap(next_, entry);
    heap_.push_back(entry);
    std::ranges::push_heap(heap_, IsLessPromising());
  } else {
    next_ = entry;
  }
}

/// The most promising entrance.
std::uint32_t ChannelSearch::pop() {
  if (next_.entrance == none || (!heap_.empty() && IsLessPromising()(next_, heap_.front()))) {
    if (next_.entrance != none) {
      heap_.push_back(next_);
      std::ranges::push_heap(heap_, IsLessPromising());
    }
    std::ranges::pop_heap(heap_, IsLessPromising());
    next_ = heap_.back();
    heap_.pop_back();
  }
  return std::exchange(next_.entrance, none);
}

/// Of the left chain, the last turning that has the point on its left; or of the right one that has
/// it on its right; or the root.
ChannelSearch::LastTurn ChannelSearch::last_turn(const Entrance& entrance, Point p) const {
  const auto side = [&](std::uint32_t turning) {
    const Turning& to = turnings_[turning];
    return cdt::orient(turnings_[to.before].place, to.place, p);
  };
  for (std::uint32_t i = entrance.left; i != entrance.root; i = turnings_[i].before)
    if (side(i) > 0) return {i, Chain::left};
  for (std::uint32_t i = entrance.right; i != entrance.root; i = turnings_[i].before)
    if (side(i) < 0) return {i, Chain::right};
  return {entrance.root, Chain::none};
}

/// No way through this channel is shorter. A goal on the root's side of the edge counts as its
/// mirror image.
double ChannelSearch::estimate(const Entrance& entrance) const {
  const Point left = mesh_->point(mesh_->from(entrance.edge));
  const Point right = mesh_->point(mesh_->to(entrance.edge));
  const bool is_beyond = cross(towards(left, right), towards(left, to_)) >= 0;
  const Point goal = is_beyond ? to_ : reflected(left, right, to_);
  const Turning& last = turnings_[last_turn(entrance, goal).turning];
  return last.length + distance_between(last.place, goal);
}

/// From the last entrance back; where a triangle was entered twice, the way round is left out.
void ChannelSearch::put_together(Channel& channel) {
  edges_.clear();
  for (std::uint32_t i = last_; i != none; i = entrances_[i].before)
    edges_.push_back(entrances_[i].edge);
  std::ranges::reverse(edges_);
  const auto position = [this](TriangleId t) -> std::uint32_t& { return positions_[t.index()]; };
  const auto add = [&](TriangleId t) {
    const std::uint32_t known = position(t);
    if (known < channel.triangles.size() && channel.triangles[known] == t) {
      channel.triangles.resize(known + 1);
      channel.portals.resize(known);
      return;
    }
    position(t) = static_cast<std::uint32_t>(channel.triangles.size());
    channel.triangles.push_back(t);
  };
  add(Triangulation::triangle(mesh_->twin(edges_.front())));
  for (const EdgeId e : edges_) {
    channel.portals.push_back({mesh_->point(mesh_->from(e)), mesh_->point(mesh_->to(e))});
    add(Triangulation::triangle(e));
  }
}

Channel find_channel(const FreeSpace& space, Point from, Point to) {
  ChannelSearch search;
  Channel channel;
  search.find(space, from, to, channel);
  return channel;
}

}  // namespace loft::paths
