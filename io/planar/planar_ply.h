// SPDX-License-Identifier: MIT
#pragma once

#include <ostream>

#include "io/planar/planar_mesh.h"

namespace loft::io {

/// Writes binary little-endian PLY: vertices with `double` coordinates, z = 0; faces with their
/// `int region` and its colour; an `edge` element with `int vertex1`, `int vertex2`,
/// `int constraint` for every constraint along every edge. The names of constraints are header
/// lines `comment constraint 0 Chile`. The same mesh gives the same bytes.
void write_planar_ply(std::ostream& out, const PlanarMesh& mesh);

}  // namespace loft::io
