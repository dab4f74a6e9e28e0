// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "cdt/point.h"
#include "reconstruct/fair/outline_net.h"

namespace loft {

/// Of the places that a point may go to the one nearest to what is wanted.
using Reach = std::function<cdt::Point(std::uint32_t point, cdt::Point wanted)>;

/// How a net is smoothed: each round takes every point `step` of the way to the mean of its
/// neighbours, then `back` of that way away from it. With a step back that is a little larger,
/// short waves go and long ones stay (Taubin, "A Signal Processing Approach to Fair Surface
/// Design", 1995); without, lines become as short as they can be.
struct Smoothing {
  unsigned rounds = 20;
  double step = 0.5;
  double back = 0;
  /// Whether all neighbours count alike; else the nearer ones for more, by how far they were at
  /// first, so that points on a straight line stay there.
  bool is_even = false;
};

/// Smooth places of the points of a net, from `places` on. After each round the loops are offset
/// towards their areas. Cost: O(rounds * n).
[[nodiscard]] std::vector<cdt::Point> relax(const OutlineNet& net, std::vector<cdt::Point> places,
                                            std::span<const double> areas, const Reach& reach,
                                            const Smoothing& how);

/// Offsets each loop until its signed area is the one in `areas`, but for that share of it. False
/// if its points could not go far enough. Cost: O(n) a round, a few of them where all can.
bool restore_areas(const OutlineNet& net, std::span<const double> areas, const Reach& reach,
                   double share, std::vector<cdt::Point>& places);

}  // namespace loft
