// SPDX-License-Identifier: MIT
#include "reconstruct/fair/contour_net.h"

#include <algorithm>

#include "cdt/predicates.h"

namespace loft {

namespace {

using cdt::Point;
using Loop = std::vector<std::uint32_t>;

/// Without points that repeat the one before.
Loop without_repeats(const Loop& numbers) {
  Loop loop;
  for (const std::uint32_t number : numbers)
    if (loop.empty() || loop.back() != number) loop.push_back(number);
  while (loop.size() > 1 && loop.back() == loop.front()) loop.pop_back();
  return loop;
}

/// Of all ways to begin the least: compares them from their least numbers on.
Loop least_rotation(const Loop& loop) {
  // Two candidates i and k; after `same` equal numbers one of them is beaten, with all the
  // beginnings that it was compared along.
  const std::size_t count = loop.size();
  std::size_t i = 0;
  std::size_t k = 1;
  std::size_t same = 0;
  while (i < count && k < count && same < count) {
    const std::uint32_t a = loop[(i + same) % count];
    const std::uint32_t b = loop[(k + same) % count];
    if (a == b) {
      ++same;
      continue;
    }
    (a > b ? i : k) += same + 1;
    if (i == k) ++k;
    same = 0;
  }
  Loop rotated = loop;
  std::rotate(rotated.begin(), rotated.begin() + static_cast<std::ptrdiff_t>(std::min(i, k)),
              rotated.end());
  return rotated;
}

Loop normal_form(const Loop& loop) {
  return std::min(least_rotation(loop), least_rotation(Loop(loop.rbegin(), loop.rend())));
}

/// Whether all points are in one line (exact).
bool encloses_nothing(const Loop& loop, std::span<const Point> points) {
  for (std::size_t k = 2; k < loop.size(); ++k)
    if (cdt::orient(points[loop[0]], points[loop[1]], points[loop[k]]) != 0) return false;
  return true;
}

}  // namespace

ContourNet make_net(std::span<const std::span<const Point>> contours) {
  ContourNet made;
  std::vector<Point>& points = made.net.points;
  for (const auto contour : contours) points.insert(points.end(), contour.begin(), contour.end());
  std::ranges::sort(points);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  std::vector<Loop> loops;
  for (const auto contour : contours) {
    Loop& numbers = made.numbers.emplace_back();
    for (const Point p : contour)
      numbers.push_back(
          static_cast<std::uint32_t>(std::ranges::lower_bound(points, p) - points.begin()));
    const Loop loop = without_repeats(numbers);
    if (encloses_nothing(loop, points)) {
      for (std::size_t k = 0; k < loop.size(); ++k) {
        const std::uint32_t next = loop[(k + 1) % loop.size()];
        made.flat_edges.emplace_back(std::min(loop[k], next), std::max(loop[k], next));
      }
    } else {
      loops.push_back(normal_form(loop));
    }
  }
  std::ranges::sort(loops);
  loops.erase(std::unique(loops.begin(), loops.end()), loops.end());
  for (const Loop& loop : loops) {
    made.net.loop_vertices.insert(made.net.loop_vertices.end(), loop.begin(), loop.end());
    made.net.end_loop();
  }
  std::ranges::sort(made.flat_edges);
  made.flat_edges.erase(std::unique(made.flat_edges.begin(), made.flat_edges.end()),
                        made.flat_edges.end());
  return made;
}

}  // namespace loft
