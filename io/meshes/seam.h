// SPDX-License-Identifier: MIT
#pragma once

#include "mesh/mesh.h"

namespace loft::io {

/// The mesh with its seams closed: where two border edges lie on one another and run against each
/// other, their ends become one vertex. For formats that cannot share all vertices: STL gives each
/// triangle its own, glTF splits vertices at sharp edges.
///
/// Places must agree exactly. Vertices at one place that no seam joins stay apart, so parts that
/// only touch still do so. Where more than two border edges lie on one another, all their ends
/// become one. Vertices keep their order; those that no face uses are dropped.
/// Precondition: indices are valid. Cost: O(n log n).
[[nodiscard]] Mesh sew_seams(const Mesh& mesh);

}  // namespace loft::io
