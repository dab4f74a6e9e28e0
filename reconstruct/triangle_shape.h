// SPDX-License-Identifier: MIT
#pragma once

#include "reconstruct/predicates.h"

namespace loft {

/// The shape of a triangle. Values do not depend on the order of the corners, bit for bit, so that
/// they may decide between triangles.

/// The smallest angle in radians: pi / 3 if all sides are equal, 0 if degenerate.
[[nodiscard]] double smallest_angle(const Corners& triangle);

/// The longest side over the height on it, scaled: 1 if all sides are equal; infinite if
/// degenerate.
[[nodiscard]] double aspect(const Corners& triangle);

}  // namespace loft
