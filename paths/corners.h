// SPDX-License-Identifier: MIT
#pragma once

#include "cdt/predicates.h"
#include "cdt/triangulation.h"

namespace loft::paths {

/// Where ways turn around a vertex: for each part of what is free there, its edges from the vertex
/// get the last one of them counter-clockwise if the part spans more than half a turn, and none
/// otherwise: set(edge, last) for every edge. beyond(edge) is the twin of an edge that can be
/// crossed, or none; is_free(triangle). Cost: the degree.
template <class IsFree, class Beyond, class Set>
void turn_corners(const cdt::Triangulation& mesh, cdt::VertexId v, IsFree is_free, Beyond beyond,
                  Set set) {
  using cdt::EdgeId;
  using cdt::Point;
  using cdt::Triangulation;
  const auto spans_half_a_turn = [&](EdgeId first, EdgeId last) {
    const Point here = mesh.point(v);
    const Point from = mesh.point(mesh.to(first));
    const Point to = mesh.point(mesh.apex(last));
    const int side = cdt::orient(here, from, to);
    const bool is_around =
        (from.x - here.x) * (to.x - here.x) >= 0 && (from.y - here.y) * (to.y - here.y) >= 0;
    return side < 0 || (side == 0 && is_around);
  };
  const EdgeId start = mesh.edge(v);
  if (start.is_none()) return;
  EdgeId first = start;  // that cannot be crossed; where there is none, ways do not turn
  while (!beyond(first).is_none()) {
    set(first, EdgeId::none());
    first = mesh.rotated(first);
    if (first == start) return;
  }
  EdgeId e = first;
  do {
    EdgeId last = e;
    bool has_corner = false;
    if (is_free(Triangulation::triangle(e))) {
      for (EdgeId on = beyond(Triangulation::prev(last)); !on.is_none();
           on = beyond(Triangulation::prev(last)))
        last = on;
      has_corner = spans_half_a_turn(e, last);
    }
    for (EdgeId one = e;; one = mesh.rotated(one)) {
      set(one, has_corner ? last : EdgeId::none());
      if (one == last) break;
    }
    e = mesh.rotated(last);
  } while (e != first);
}

}  // namespace loft::paths
