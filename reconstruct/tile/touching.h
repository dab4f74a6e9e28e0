// SPDX-License-Identifier: MIT
#pragma once

#include "mesh/predicates.h"

namespace loft {

/// Whether two triangles come nearer to each other than `distance` elsewhere than at corners that
/// they have in common: an edge to an edge, or a corner to the other's inside. By rounding alone
/// such triangles may meet, or not.
[[nodiscard]] bool triangles_touch(const Corners& a, const Corners& b, double distance);

}  // namespace loft
