// SPDX-License-Identifier: MIT
#include "paths/dead_ends.h"

#include <algorithm>
#include <utility>

namespace loft::paths {

void DeadEnds::begin(const FreeSpace& space, std::span<const TriangleId> goals) {
  prepare(space, 0);
  if (is_built_) mark(goals);
}

void DeadEnds::prepare(const FreeSpace& space, std::size_t expansions) {
  if (state_ != space.state()) {
    state_ = space.state();
    spent_ = 0;
    is_built_ = false;
  }
  spent_ += expansions;
  if (!is_built_ && spent_ > space.mesh().triangle_bound()) build(space);
}

void DeadEnds::build(const FreeSpace& space) {
  is_built_ = true;
  const std::size_t triangles = space.mesh().triangle_bound();
  part_of_.assign(triangles, none);
  order_.assign(triangles, none);
  oldest_.resize(triangles);
  parts_.clear();
  mark_ = 0;
  count_ = 0;
  for (std::uint32_t i = 0; i < triangles; ++i)
    if (order_[i] == none) gather_parts(space, TriangleId(i));
  for (Part& part : parts_)
    if (part.above != none) part.above = part_of_[part.above];
}

/// The parts of all that is joined to a triangle, deep before wide. What leads back to nothing
/// before it, but for the edge over which it was come to, is beyond a bridge, with all since.
void DeadEnds::gather_parts(const FreeSpace& space, TriangleId start) {
  come_to(start, EdgeId::none());
  while (!way_.empty()) {
    Visit& here = way_.back();
    if (here.corner < 3) {
      const EdgeId e = Triangulation::edge(here.triangle, here.corner++);
      const EdgeId entry = space.beyond(e);
      if (entry.is_none() || e == here.entry) continue;
      const TriangleId next = Triangulation::triangle(entry);
      if (order_[next.index()] == none)
        come_to(next, entry);
      else
        lead_back(here.triangle, order_[next.index()]);
      continue;
    }
    const TriangleId done = here.triangle;
    way_.pop_back();
    const std::uint32_t before = way_.empty() ? none : way_.back().triangle.index();
    if (oldest_[done.index()] == order_[done.index()])
      close_part(done, before);
    else
      lead_back(TriangleId(before), oldest_[done.index()]);
  }
}

void DeadEnds::come_to(TriangleId t, EdgeId entry) {
  order_[t.index()] = oldest_[t.index()] = count_++;
  open_.push_back(t);
  way_.push_back({.triangle = t, .entry = entry});
}

void DeadEnds::lead_back(TriangleId t, std::uint32_t to) {
  oldest_[t.index()] = std::min(oldest_[t.index()], to);
}

/// All since `first` is a part, beyond a bridge from the triangle `before`.
void DeadEnds::close_part(TriangleId first, std::uint32_t before) {
  const auto number = static_cast<std::uint32_t>(parts_.size());
  parts_.push_back({.above = before});
  while (part_of_[first.index()] == none) {
    part_of_[open_.back().index()] = number;
    open_.pop_back();
  }
}

void DeadEnds::mark(std::span<const TriangleId> goals) {
  if (++mark_ == 0) {
    for (Part& part : parts_) part.mark = 0;
    mark_ = 1;
  }
  goals_ = static_cast<std::uint32_t>(goals.size());
  for (const TriangleId goal : goals)
    for (std::uint32_t p = part_of_[goal.index()]; p != none; p = parts_[p].above) {
      const bool is_marked = std::exchange(parts_[p].mark, mark_) == mark_;
      parts_[p].goals = is_marked ? parts_[p].goals + 1 : 1;
    }
}

}  // namespace loft::paths
