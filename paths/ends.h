// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <vector>

#include "paths/free_space.h"
#include "paths/path.h"

namespace loft::paths {

/// Where a search begins and ends: the triangles at start and goal that a way leads from and to.
struct Ends {
  std::vector<TriangleId> starts;
  std::vector<TriangleId> goals;

  /// found, if there are any; else why there are none.
  [[nodiscard]] Status find(const FreeSpace& space, Point from, Point to) {
    space.triangles_at(from, starts);
    space.triangles_at(to, goals);
    if (starts.empty()) return Status::start_blocked;
    if (goals.empty()) return Status::goal_blocked;
    std::erase_if(starts, [&](TriangleId t) { return !space.is_joined({&t, 1}, goals); });
    std::erase_if(goals, [&](TriangleId t) { return !space.is_joined({&t, 1}, starts); });
    return starts.empty() ? Status::unreachable : Status::found;
  }
  [[nodiscard]] bool is_goal(TriangleId t) const {
    return std::ranges::find(goals, t) != goals.end();
  }
};

/// The edge of a triangle from the corner that coordinates put first.
[[nodiscard]] inline EdgeId first_edge(const Triangulation& mesh, TriangleId t) {
  EdgeId first = Triangulation::edge(t);
  for (unsigned corner = 1; corner < 3; ++corner) {
    const EdgeId e = Triangulation::edge(t, corner);
    if (mesh.point(mesh.from(e)) < mesh.point(mesh.from(first))) first = e;
  }
  return first;
}

}  // namespace loft::paths
