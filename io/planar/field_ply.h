// SPDX-License-Identifier: MIT
#pragma once

#include <iosfwd>

#include "fields/field.h"

namespace loft::io {

/// Writes the linear surface as binary little-endian PLY: vertices with `double` x, y, z and
/// `value`, which is z, and triangles. A place beside walls has a vertex for each of its values.
/// Vertices are sorted, so that the same surface gives the same bytes. Cost: O(n log n).
void write_field_ply(std::ostream& out, const fields::Field& field);

}  // namespace loft::io
