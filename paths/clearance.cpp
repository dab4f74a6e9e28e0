// SPDX-License-Identifier: MIT
#include "paths/clearance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "paths/distance.h"
#include "paths/exact_distance.h"
#include "paths/expect_followed.h"

namespace loft::paths {

namespace {

/// Calls look(edge) for the sides of triangles that can be seen from a point, from near to far as
/// long as sides are within what reach() says, some further ones perhaps: those beyond which
/// nothing can be seen, and the others. A triangle has no more than one way to it, so none is seen
/// twice but around obstacles.
template <class Reach, class Look>
void look_around(const Gaps& gaps, Point p, TriangleId start, std::vector<TriangleId>& seen,
                 Reach reach, Look look) {
  const Triangulation& mesh = gaps.mesh();
  seen.assign(1, start);
  for (std::size_t i = 0; i < seen.size(); ++i) {
    for (unsigned corner = 0; corner < 3; ++corner) {
      const EdgeId e = Triangulation::edge(seen[i], corner);
      look(e);
      const EdgeId beyond = gaps.beyond(e);
      if (beyond.is_none()) continue;
      const TriangleId next = Triangulation::triangle(beyond);
      const double away = distance_to_segment(p, mesh.point(mesh.from(e)), mesh.point(mesh.to(e)));
      if (away > reach() * (1 + 0x1p-40) || std::ranges::find(seen, next) != seen.end()) continue;
      seen.push_back(next);
    }
  }
}

/// The ends of the whole segment along a wall's edge, without rounded points between.
[[nodiscard]] std::pair<Point, Point> whole_side(const Triangulation& mesh, EdgeId e) {
  const cdt::Segment& side = mesh.segment(mesh.passages(e)[0].segment());
  return {mesh.point(side.from), mesh.point(side.to)};
}

}  // namespace

const Gaps& gaps_of(const FreeSpace& space) {
  expect_followed(space);
  if (space.gaps() == nullptr)
    throw std::logic_error("paths: a radius above 0 asks for FreeSpace::keep_gaps()");
  return *space.gaps();
}

TriangleId triangle_in_gaps(const Gaps& gaps, Point p) {
  const Triangulation& mesh = gaps.mesh();
  const cdt::Location place = mesh.locate(p);
  if (place.kind == cdt::Location::Kind::nowhere) return TriangleId::none();
  TriangleId found;
  const auto look = [&](EdgeId e) {
    if (found.is_none() && gaps.is_free(Triangulation::triangle(e)))
      found = Triangulation::triangle(e);
  };
  look(place.edge);
  if (place.kind == cdt::Location::Kind::edge) look(mesh.twin(place.edge));
  if (place.kind == cdt::Location::Kind::vertex)
    for (EdgeId e = mesh.rotated(place.edge); e != place.edge; e = mesh.rotated(e)) look(e);
  return found;
}

double clearance(const FreeSpace& space, Point p) {
  const Gaps& gaps = gaps_of(space);
  const TriangleId start = triangle_in_gaps(gaps, p);
  if (start.is_none() || !space.is_free(p)) return 0;
  const Triangulation& mesh = gaps.mesh();
  double least = std::numeric_limits<double>::infinity();
  std::vector<TriangleId> seen;
  look_around(
      gaps, p, start, seen, [&] { return least; },
      [&](EdgeId e) {
        const Point a = mesh.point(mesh.from(e));
        least = std::min(least, distance_between(a, p));
        if (!mesh.is_constrained(e)) return;
        const auto [from, to] = whole_side(mesh, e);
        least = std::min(least, distance_to_segment(p, from, to));
      });
  return least;
}

bool is_clear(const FreeSpace& space, Point p, double radius) {
  std::vector<TriangleId> seen;
  return is_clear(space, p, radius, seen);
}

bool is_clear(const FreeSpace& space, Point p, double radius, std::vector<TriangleId>& scratch) {
  const Gaps& gaps = gaps_of(space);
  const TriangleId start = triangle_in_gaps(gaps, p);
  if (start.is_none()) return false;
  const Triangulation& mesh = gaps.mesh();
  bool is_so = true;
  look_around(
      gaps, p, start, scratch, [&] { return is_so ? radius : -1; },
      [&](EdgeId e) {
        if (!gaps.is_foot(mesh.from(e)))
          is_so = is_so && is_as_far(p, mesh.point(mesh.from(e)), radius);
        if (!mesh.is_constrained(e)) return;
        const auto [from, to] = whole_side(mesh, e);
        is_so = is_so && is_as_far_from_segment(p, from, to, radius);
      });
  return is_so;
}

namespace {

/// The largest double near `guess` for which holds(radius), which is so for all below it.
template <class Holds>
[[nodiscard]] double largest(double guess, Holds holds) {
  if (!std::isfinite(guess)) return guess;
  double low = guess;
  double high = guess;
  for (double step = 0x1p-50; low > 0 && !holds(low); step *= 2)
    low = step < 1 ? guess * (1 - step) : 0;
  for (double step = 0x1p-50; low > 0 && holds(high); step *= 2) {
    low = high;
    high = guess * (1 + step);
  }
  while (low < high) {
    const double middle = low + (high - low) / 2;
    if (middle == low || middle == high) break;
    (holds(middle) ? low : high) = middle;
  }
  return low;
}

}  // namespace

double widest(const FreeSpace& space, Point from, Point to) {
  const Gaps& gaps = gaps_of(space);
  if (!space.is_reachable(from, to)) return -1;
  const TriangleId start = triangle_in_gaps(gaps, from);
  const TriangleId goal = triangle_in_gaps(gaps, to);
  struct Way {
    double width;
    TriangleId triangle;
    EdgeId narrowest;
    bool operator<(const Way& other) const { return width < other.width; }
  };
  std::vector<Way> heap{{std::numeric_limits<double>::infinity(), start, {}}};
  std::vector<bool> is_done(gaps.mesh().triangle_bound());
  EdgeId narrowest;
  while (!heap.empty()) {
    std::ranges::pop_heap(heap, std::less<>());
    const Way way = heap.back();
    heap.pop_back();
    if (is_done[way.triangle.index()]) continue;
    is_done[way.triangle.index()] = true;
    narrowest = way.narrowest;
    if (way.triangle == goal) break;
    for (unsigned corner = 0; corner < 3; ++corner) {
      const EdgeId e = Triangulation::edge(way.triangle, corner);
      const EdgeId beyond = gaps.beyond(e);
      if (beyond.is_none() || is_done[Triangulation::triangle(beyond).index()]) continue;
      const bool is_narrower = gaps.width(e) < way.width;
      heap.push_back({is_narrower ? gaps.width(e) : way.width, Triangulation::triangle(beyond),
                      is_narrower ? e : way.narrowest});
      std::ranges::push_heap(heap, std::less<>());
    }
  }
  const auto at = [&](Point p) {
    return largest(clearance(space, p), [&](double r) { return is_clear(space, p, r); });
  };
  double radius = std::min(at(from), at(to));
  if (!narrowest.is_none())
    radius = std::min(radius, largest(gaps.width(narrowest) / 2,
                                      [&](double r) { return gaps.is_passable(narrowest, r); }));
  return radius;
}

}  // namespace loft::paths
