// SPDX-License-Identifier: MIT
#pragma once

#include "cdt/triangulation.h"

namespace loft::cdt {

/// The sector of an edge is what is around from(e), on the left of e, between constrained edges:
/// triangles that are joined there across edges without passages.

/// The first edge of a sector between edges of any kind, those for which parts(edge) holds,
/// clockwise; if there is none around the vertex, e itself. Cost: the triangles between.
template <class Parts>
[[nodiscard]] EdgeId sector_begin(const Triangulation& mesh, EdgeId e, Parts parts) {
  EdgeId first = e;
  while (!parts(first)) {
    first = Triangulation::next(mesh.twin(first));
    if (first == e) break;
  }
  return first;
}

/// The same between constrained edges.
[[nodiscard]] inline EdgeId sector_begin(const Triangulation& mesh, EdgeId e) {
  return sector_begin(mesh, e, [&](EdgeId side) { return mesh.is_constrained(side); });
}

/// Calls visit(edge) for each triangle of a sector between edges of any kind, counter-clockwise: an
/// edge from the vertex that has it on its left. Infinite triangles count. Returns the edge where
/// the sector ends: the first, if it is all around. Cost: the triangles in it.
template <class Parts, class Visit>
EdgeId visit_sector(const Triangulation& mesh, EdgeId e, Parts parts, Visit visit) {
  const EdgeId first = sector_begin(mesh, e, parts);
  EdgeId here = first;
  do {
    visit(here);
    here = mesh.rotated(here);
  } while (here != first && !parts(here));
  return here;
}

/// The same between constrained edges.
template <class Visit>
void visit_sector(const Triangulation& mesh, EdgeId e, Visit visit) {
  visit_sector(
      mesh, e, [&](EdgeId side) { return mesh.is_constrained(side); }, visit);
}

}  // namespace loft::cdt
