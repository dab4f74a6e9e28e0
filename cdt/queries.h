// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "cdt/triangulation.h"

namespace loft::cdt {

/// The vertex nearest to a point, whatever constraints are between; of several as near, that which
/// the coordinates put first. None if there is no vertex. Distances are compared exactly.
/// Cost: that of locate(), then the triangles nearer than the answer.
[[nodiscard]] VertexId nearest_vertex(const Triangulation& mesh, Point point);

/// The box around all vertices; empty if there are none. Cost: O(vertices).
[[nodiscard]] Box bounding_box(const Triangulation& mesh);

/// A part of a straight way, from one edge or vertex on it to the next: inside a triangle, or along
/// an edge.
struct WayPart {
  TriangleId triangle;  ///< none: along an edge
  EdgeId along;         ///< that edge, in the direction of the way
  EdgeId exit;   ///< the edge it leaves the triangle through, which is on its left; none: see `end`
  VertexId end;  ///< the vertex that it comes to; none of both: the way ends inside this part
};

/// What a segment passes.
struct Way {
  EdgeId entry;    ///< of one that begins beyond the hull: the edge it comes in through, seen from
                   ///< outside
  VertexId start;  ///< the vertex that it begins at, or comes to from beyond the hull
  std::vector<WayPart> parts;
};

/// The parts of the segment from a to b that are inside the hull or on it, in order; constraints do
/// not stop it. Of edges that only touch it nothing is said. Exact. Precondition: a and b are
/// finite. Cost: that of locate(), then the edges crossed and the degrees of the vertices that are
/// on the segment.
[[nodiscard]] Way passed_by(const Triangulation& mesh, Point a, Point b);

/// Of these, the finite triangles whose inside it passes: along an edge none of those beside it.
[[nodiscard]] std::vector<TriangleId> crossed_triangles(const Triangulation& mesh, Point a,
                                                        Point b);

}  // namespace loft::cdt
