// SPDX-License-Identifier: MIT
#include "reconstruct/fair/edge_meetings.h"

#include <algorithm>

#include "cdt/predicates.h"
#include "reconstruct/plane/tile_grid.h"

namespace loft {

namespace {

using cdt::Point;

cdt::Box box_of(const NetEdge& edge, std::span<const Point> places) {
  cdt::Box box;
  box.add(places[edge.first]);
  box.add(places[edge.second]);
  return box;
}

/// Whether p is on the segment ab.
bool is_on(Point a, Point b, Point p) {
  return std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= p.y &&
         p.y <= std::max(a.y, b.y) && cdt::orient(a, b, p) == 0;
}

}  // namespace

bool do_meet(const NetEdge& one, const NetEdge& other, std::span<const Point> places) {
  NetEdge first = one;
  NetEdge second = other;
  if (first.second == second.first || first.second == second.second)
    std::swap(first.first, first.second);
  if (second.second == first.first) std::swap(second.first, second.second);
  const Point a = places[first.first];
  const Point b = places[first.second];
  const Point c = places[second.first];
  const Point d = places[second.second];
  if (first.first == second.first)  // a fan: one lies upon the other, or has no length
    return first.second == second.second || is_on(a, b, d) || is_on(c, d, b);
  return cdt::crosses(a, b, c, d) || is_on(a, b, c) || is_on(a, b, d) || is_on(c, d, a) ||
         is_on(c, d, b);
}

std::vector<std::pair<std::uint32_t, std::uint32_t>> find_meetings(std::span<const NetEdge> edges,
                                                                   std::span<const Point> places) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> found;
  TileGrid grid(edges.size(), [&](std::uint32_t i) { return box_of(edges[i], places); });
  for (std::uint32_t i = 0; i < edges.size(); ++i) {
    const cdt::Box box = box_of(edges[i], places);
    const std::size_t first = found.size();
    static_cast<void>(grid.all_of_near(box, [&](std::uint32_t k) {
      if (k > i && boxes_meet(box, box_of(edges[k], places)) && do_meet(edges[i], edges[k], places))
        found.emplace_back(i, k);
      return true;
    }));
    const auto begin = found.begin() + static_cast<std::ptrdiff_t>(first);
    std::sort(begin, found.end());
    found.erase(std::unique(begin, found.end()), found.end());
  }
  return found;
}

}  // namespace loft
