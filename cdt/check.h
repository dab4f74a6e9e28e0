// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "cdt/triangulation.h"

namespace loft::cdt {

/// What can be wrong with a triangulation. None of it should ever be seen.
enum class Fault {
  topology,   ///< twins, corners or sets of edges do not fit together
  inverted,   ///< a triangle is not counter-clockwise, or the hull not convex
  delaunay,   ///< an edge without passage is not constrained Delaunay
  uncovered,  ///< a segment's edges do not lead from its start to its end
  astray,     ///< they lead off its line: further than 2^-50 of its largest coordinate
};

struct Finding {
  Fault fault;
  EdgeId edge;        ///< topology, inverted, delaunay
  SegmentId segment;  ///< uncovered, astray
  std::string message;
};

/// Everything that is wrong, by exact tests; empty if nothing is. Where split() has put a vertex
/// off a line that is no finding, nor is it with an epsilon, by which segments may be led astray.
/// Cost: O(triangles + pieces of segments x degree).
[[nodiscard]] std::vector<Finding> check(const Triangulation& mesh);

}  // namespace loft::cdt
