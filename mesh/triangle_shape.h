// SPDX-License-Identifier: MIT
#pragma once

#include "mesh/predicates.h"

namespace loft {

/// The shape of a triangle. Values do not depend on the order of the corners, bit for bit, so that
/// they may decide between triangles.

/// The sine of the smallest angle: that of 60 degrees if all sides are equal, 0 if degenerate.
[[nodiscard]] double smallest_sine(const Corners& triangle);

/// The longest side over the height on it, scaled: 1 if all sides are equal; infinite if
/// degenerate.
[[nodiscard]] double aspect(const Corners& triangle);

}  // namespace loft
