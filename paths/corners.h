// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "cdt/predicates.h"
#include "cdt/triangulation.h"

namespace loft::paths {

/// Where ways turn around a vertex: for each part of what is free there, its edges from the vertex
/// have the last one of them counter-clockwise in `corners` if the part spans more than half a
/// turn, and none otherwise. beyond(edge) is the twin of an edge that can be crossed, or none;
/// is_free(triangle). Cost: the degree.
template <class IsFree, class Beyond>
void turn_corners(const cdt::Triangulation& mesh, cdt::VertexId v, IsFree is_free, Beyond beyond,
                  std::vector<cdt::EdgeId>& corners) {
  using cdt::EdgeId;
  using cdt::Point;
  using cdt::Triangulation;
  const EdgeId start = mesh.edge(v);
  if (start.is_none()) return;
  const auto onward = [&](EdgeId e) { return beyond(Triangulation::prev(e)); };
  const auto spans_half_a_turn = [&](EdgeId first, EdgeId last) {
    const Point here = mesh.point(v);
    const Point from = mesh.point(mesh.to(first));
    const Point to = mesh.point(mesh.apex(last));
    const int side = cdt::orient(here, from, to);
    const bool is_around =
        (from.x - here.x) * (to.x - here.x) >= 0 && (from.y - here.y) * (to.y - here.y) >= 0;
    return side < 0 || (side == 0 && is_around);
  };
  EdgeId e = start;
  do {
    corners[e.index()] = EdgeId::none();
    e = mesh.rotated(e);
  } while (e != start);
  do {
    if (beyond(e).is_none() && is_free(Triangulation::triangle(e))) {
      EdgeId last = e;
      while (!onward(last).is_none()) last = onward(last);
      if (spans_half_a_turn(e, last)) {
        for (EdgeId one = e;; one = onward(one)) {
          corners[one.index()] = last;
          if (one == last) break;
        }
      }
    }
    e = mesh.rotated(e);
  } while (e != start);
}

}  // namespace loft::paths
