// SPDX-License-Identifier: MIT
#pragma once

#include "cdt/triangulation.h"

namespace loft::cdt {

/// The sector of an edge is what is around from(e), on the left of e, between constrained edges:
/// triangles that are joined there across edges without passages.

/// The first edge of the sector, clockwise: a constrained one, or, if there is none around the
/// vertex, e itself. Cost: the triangles between.
[[nodiscard]] inline EdgeId sector_begin(const Triangulation& mesh, EdgeId e) {
  EdgeId first = e;
  while (!mesh.is_constrained(first)) {
    first = Triangulation::next(mesh.twin(first));
    if (first == e) break;
  }
  return first;
}

/// Calls visit(edge) for each triangle of the sector, counter-clockwise: an edge from the vertex
/// that has it on its left. Infinite triangles count. Cost: the triangles in it.
template <class Visit>
void visit_sector(const Triangulation& mesh, EdgeId e, Visit visit) {
  const EdgeId first = sector_begin(mesh, e);
  EdgeId here = first;
  do {
    visit(here);
    here = mesh.rotated(here);
  } while (here != first && !mesh.is_constrained(here));
}

}  // namespace loft::cdt
