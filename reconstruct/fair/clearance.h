// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cdt/point.h"
#include "mesh/adjacency.h"
#include "reconstruct/fair/edge_meetings.h"

namespace loft {

/// How far each point may move, at most `distance` and eight times its longest edge, so that edges
/// of different components cannot meet on the way: less than half as far as its edges are from
/// those of others. `components`: of points that edges join, or something else does. Cost: O(n)
/// where few are nearer to each other than twice that.
[[nodiscard]] std::vector<double> clearances(std::span<const NetEdge> edges,
                                             std::span<const cdt::Point> places,
                                             DisjointSets& components, double distance);

}  // namespace loft
