// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "cdt/triangulation.h"

namespace loft::cdt {

/// The vertex nearest to a point, whatever constraints are between; of several as near, that which
/// the coordinates put first. None if there is no vertex. Distances are compared exactly.
/// Cost: that of locate(), then the triangles nearer than the answer.
[[nodiscard]] VertexId nearest_vertex(const Triangulation& mesh, Point point);

/// The finite triangles whose inside the segment from a to b passes, in the order in which it does;
/// constraints do not stop it. A segment along an edge passes neither of the triangles beside it.
/// Exact. Precondition: a and b are finite. Cost: that of locate(), then the edges crossed and the
/// degrees of the vertices that are on the segment.
[[nodiscard]] std::vector<TriangleId> crossed_triangles(const Triangulation& mesh, Point a,
                                                        Point b);

}  // namespace loft::cdt
