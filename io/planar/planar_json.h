// SPDX-License-Identifier: MIT
#pragma once

#include <ostream>

#include "io/planar/planar_mesh.h"

namespace loft::io {

/// Writes a triangulation as one JSON object with schema version 1, an item a line:
///
///     schema "loft-triangulation", schema_version 1, generator
///     vertices       [x, y] each, sorted
///     triangles      three vertices each, counter-clockwise, the smallest first, sorted
///     regions        {"odd": true, "triangles": 12} each: triangles without a constrained edge
///                    between them; odd if an odd number of closed constraints is around it
///     region_of      the region of each triangle
///     constrained_edges  {"vertices": [3, 7], "constraints": [0, 5]} each, sorted
///     constraints    {"name": "Chile", "closed": true, "vertices": [3, 7, 9, 3]} each: the
///                    vertices that it passes, in its direction; no name where it has none
///
/// Everything is numbered from 0. Numbers have as many digits as give them back exactly. The same
/// mesh gives the same bytes. Later versions of the schema may add keys.
/// Precondition: names are UTF-8.
void write_planar_json(std::ostream& out, const PlanarMesh& mesh);

}  // namespace loft::io
