// SPDX-License-Identifier: MIT
#pragma once

#include <ostream>

#include "io/planar/planar_mesh.h"

namespace loft::io {

/// How a triangulation is drawn.
struct SvgOptions {
  double width = 1200;    ///< of the picture, in pixels; the height follows
  bool has_fill = true;   ///< regions are coloured
  bool has_edges = true;  ///< edges without constraint are drawn
};

/// Draws a triangulation, y upwards. Regions that the same names enclose have one colour, full
/// where an odd number of constraints is around them and pale where an even number is; what nothing
/// encloses looks like water. A constrained edge has the colour of its constraint, a dark one where
/// it has several; a constraint that is a point is a dot.
///
/// Coordinates are rounded to hundredths of a pixel. Every edge is drawn once, with few and short
/// words: 500,000 vertices take about 15 MB. The same mesh gives the same bytes.
/// Cost: O(n log n), with the picture in memory.
void write_svg(std::ostream& out, const PlanarMesh& mesh, const SvgOptions& options = {});

}  // namespace loft::io
