// SPDX-License-Identifier: MIT
#include "reconstruct/fair/clearance.h"

#include <algorithm>
#include <cmath>

#include "reconstruct/plane/nearest.h"
#include "reconstruct/plane/tile_grid.h"

namespace loft {

namespace {

using cdt::Point;

/// Of the half of a distance; the rest is for rounding.
constexpr double share_of_gap = 0.49;
/// Of its longest edge, how far a point may go: more than smoothing asks for, and edges need not be
/// compared with all others, however large the distance.
constexpr double most_lengths = 8;

/// Of edges that do not meet.
double distance_between(const NetEdge& one, const NetEdge& other, std::span<const Point> places) {
  const Point a = places[one.first];
  const Point b = places[one.second];
  const Point c = places[other.first];
  const Point d = places[other.second];
  return std::min({distance(a, c, d), distance(b, c, d), distance(c, a, b), distance(d, a, b)});
}

}  // namespace

std::vector<double> clearances(std::span<const NetEdge> edges, std::span<const Point> places,
                               DisjointSets& components, double distance) {
  std::vector<double> found(places.size());
  for (const auto& [a, b] : edges)
    for (const std::uint32_t end : {a, b})
      found[end] =
          std::max(found[end], std::hypot(places[a].x - places[b].x, places[a].y - places[b].y));
  for (double& reach : found) reach = std::min(distance, most_lengths * reach);
  const std::vector<double> most = found;
  const auto box_of = [&](std::uint32_t i, double around) {
    cdt::Box box;
    for (const std::uint32_t end : {edges[i].first, edges[i].second}) {
      box.add({places[end].x - around, places[end].y - around});
      box.add({places[end].x + around, places[end].y + around});
    }
    return box;
  };
  TileGrid grid(edges.size(), [&](std::uint32_t i) { return box_of(i, 0); });
  for (std::uint32_t i = 0; i < edges.size(); ++i) {
    const double far = std::max(most[edges[i].first], most[edges[i].second]) / share_of_gap;
    const cdt::Box box = box_of(i, far);
    double least = far;
    static_cast<void>(grid.all_of_near(box, [&](std::uint32_t k) {
      if (components.find(edges[i].first) != components.find(edges[k].first) &&
          boxes_meet(box, box_of(k, 0)))
        least = std::min(least, distance_between(edges[i], edges[k], places));
      return true;
    }));
    for (const std::uint32_t end : {edges[i].first, edges[i].second})
      found[end] = std::min(found[end], share_of_gap * least);
  }
  return found;
}

}  // namespace loft
