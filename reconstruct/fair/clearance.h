// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cdt/point.h"
#include "reconstruct/fair/edge_meetings.h"

namespace loft {

/// Sets of points that edges join, or that are joined by something else.
class Components {
 public:
  explicit Components(std::size_t points);

  void join(std::uint32_t a, std::uint32_t b);
  /// A point that stands for all that are joined to this one.
  [[nodiscard]] std::uint32_t of(std::uint32_t point) const;

 private:
  mutable std::vector<std::uint32_t> parent_;
};

/// How far each point may move, at most `distance` and eight times its longest edge, so that edges
/// of different components cannot meet on the way: less than half as far as its edges are from
/// those of others. Cost: O(n) where few are nearer to each other than twice that.
[[nodiscard]] std::vector<double> clearances(std::span<const NetEdge> edges,
                                             std::span<const cdt::Point> places,
                                             const Components& components, double distance);

}  // namespace loft
