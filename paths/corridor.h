// SPDX-License-Identifier: MIT
#pragma once

#include "overlay/polygon.h"
#include "paths/path.h"

namespace loft::paths {

/// What a disc of radius `half_width` covers on its way along a path: all that is no further from
/// it than that, round at both ends and around every turn; polygons as Overlay::polygons() says,
/// one of them unless the path has gaps, with a hole where the path encloses something that it does
/// not cover. Curves become chords, corners of which are on the curve: the border is nowhere
/// further than `most_error` from the true one (where that is not below 2^-40 of the radii: no
/// curve gets more corners than for that). None if the path has no pieces.
///
/// The same bytes on every machine: no angle is computed. Cost: an overlay of the pieces, each with
/// O(sqrt(half_width / most_error)) corners.
/// Throws std::invalid_argument unless half_width and most_error are finite and above 0, and if
/// coordinates are not usable.
[[nodiscard]] overlay::MultiPolygon corridor(const Path& path, double half_width,
                                             double most_error);

}  // namespace loft::paths
