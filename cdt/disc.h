// SPDX-License-Identifier: MIT
#pragma once

#include <unordered_set>
#include <vector>

#include "cdt/rounding.h"
#include "cdt/triangulation.h"

namespace loft::cdt {

/// Calls visit(triangle) for the triangles, infinite ones included, that come as near to p as
/// radius(), which may shrink on the way, from `place`, where p is, outwards. Cost: in their
/// number.
template <class Radius, class Visit>
void visit_disc(const Triangulation& mesh, Location place, Point p, Radius radius, Visit visit) {
  std::unordered_set<TriangleId> seen;
  std::vector<EdgeId> front;
  const auto distance_to = [&](EdgeId e) {
    if (mesh.from(e) == Triangulation::infinite) return distance(mesh.point(mesh.to(e)), p);
    if (mesh.to(e) == Triangulation::infinite) return distance(mesh.point(mesh.from(e)), p);
    return distance_to_segment(mesh.point(mesh.from(e)), mesh.point(mesh.to(e)), p);
  };
  /// By how much rounding may have made that too large.
  const auto doubt_about = [&](EdgeId e) {
    const VertexId v = mesh.from(e) == Triangulation::infinite ? mesh.to(e) : mesh.from(e);
    return 8 * detail::rounding * distance(mesh.point(v), p);
  };
  const auto enter = [&](EdgeId e) {
    const TriangleId t = Triangulation::triangle(e);
    if (!seen.insert(t).second) return;
    for (const EdgeId side : {e, Triangulation::next(e), Triangulation::prev(e)})
      front.push_back(side);
    visit(t);
  };
  // Beyond the hull, first along it to where it is nearest.
  EdgeId start = place.edge;
  if (place.kind == Location::Kind::outside) {
    while (mesh.apex(start) != Triangulation::infinite) start = Triangulation::next(start);
    for (;;) {
      const EdgeId after = Triangulation::next(mesh.twin(Triangulation::next(start)));
      const EdgeId before = Triangulation::prev(mesh.twin(Triangulation::prev(start)));
      if (distance_to(after) < distance_to(start)) {
        start = after;
      } else if (distance_to(before) < distance_to(start)) {
        start = before;
      } else {
        break;
      }
    }
    enter(mesh.twin(start));
  }
  enter(start);
  while (!front.empty()) {
    const EdgeId e = front.back();
    front.pop_back();
    if (distance_to(e) - doubt_about(e) <= radius()) enter(mesh.twin(e));
  }
}

}  // namespace loft::cdt
