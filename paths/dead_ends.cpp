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
  const auto triangles = static_cast<std::uint32_t>(space.mesh().triangle_bound());
  onward_.assign(triangles, core);
  marks_.assign(triangles, 0);
  goals_here_.assign(triangles, 0);
  mark_ = 0;
  std::vector<std::uint8_t> open_sides(triangles);
  std::vector<TriangleId> ends;
  for (std::uint32_t i = 0; i < triangles; ++i) {
    const TriangleId t(i);
    for (unsigned corner = 0; corner < 3; ++corner)
      if (!space.beyond(Triangulation::edge(t, corner)).is_none()) ++open_sides[i];
    if (open_sides[i] <= 1) ends.push_back(t);
  }
  while (!ends.empty()) {
    const TriangleId t = ends.back();
    ends.pop_back();
    onward_[t.index()] = root;
    for (unsigned corner = 0; corner < 3; ++corner) {
      const EdgeId entry = space.beyond(Triangulation::edge(t, corner));
      if (entry.is_none()) continue;
      const TriangleId next = Triangulation::triangle(entry);
      if (onward_[next.index()] != core) continue;
      onward_[t.index()] = next.index();
      if (--open_sides[next.index()] == 1) ends.push_back(next);
    }
  }
}

void DeadEnds::mark(std::span<const TriangleId> goals) {
  if (++mark_ == 0) {
    std::ranges::fill(marks_, 0);
    mark_ = 1;
  }
  goals_ = static_cast<std::uint32_t>(goals.size());
  for (const TriangleId goal : goals)
    for (std::uint32_t t = goal.index(); onward_[t] != core; t = onward_[t]) {
      goals_here_[t] = std::exchange(marks_[t], mark_) == mark_ ? goals_here_[t] + 1 : 1;
      if (onward_[t] == root) break;
    }
}

}  // namespace loft::paths
