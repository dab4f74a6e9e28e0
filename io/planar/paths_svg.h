// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <ostream>
#include <vector>

#include "cdt/point.h"
#include "io/planar/svg_frame.h"
#include "overlay/polygon.h"
#include "paths/path.h"

namespace loft::io {

/// A way in a picture.
struct DrawnPath {
  paths::Query query;
  paths::Path path = {};
  std::size_t hue = 0;    ///< a colour by its number; they come again after eight
  bool is_faint = false;  ///< one of a time before
};

/// Ways through what is free.
struct PathPicture {
  overlay::MultiPolygon free = {};
  std::vector<std::vector<cdt::Point>> walls = {};
  std::vector<DrawnPath> paths = {};  ///< later ones lie above
  Upwards upwards = Upwards::y;
};

/// Draws what is free, pale, walls as lines, and paths with dots at start and goal; where nothing
/// was found, the dots alone. Arcs are arcs. The band that a disc sweeps shines through.
/// Coordinates are rounded to hundredths of a pixel. The same picture gives the same bytes. Cost:
/// O(n).
void write_paths_svg(std::ostream& out, const PathPicture& picture, double width = 1200);

}  // namespace loft::io
