// SPDX-License-Identifier: MIT
#pragma once

#include <ostream>

#include "io/planar/map.h"
#include "io/planar/svg.h"

namespace loft::io {

/// Draws a map as write_svg() draws the triangulation of its outlines, lines and points, without
/// the edges between: what features with the same property `name` enclose has one colour,
/// neighbours differ. The same map gives the same bytes. Cost: O(n log n), with the picture in
/// memory.
void write_map_svg(std::ostream& out, const Map& map, const SvgOptions& options = {});

}  // namespace loft::io
