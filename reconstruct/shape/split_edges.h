// SPDX-License-Identifier: MIT
#pragma once

#include "reconstruct/shape/tile_mesh.h"

namespace loft {

/// Throws InputError if edges that short would make more tiles than can be meant.
void check_size(const TileMesh& mesh, double longest);

/// Splits the inner edges longer than `longest`, as far as they are the longest of each tile at
/// them: longest first, at their middles. Whether there were any.
bool split_edges(TileMesh& mesh, double longest);

}  // namespace loft
