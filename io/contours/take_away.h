// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "cdt/point.h"
#include "reconstruct/slice.h"

namespace loft::io {

/// What is in some contours, wherever they lie in one another, but in none of others: by its
/// outlines, counter-clockwise, and its holes, clockwise. Precondition: coordinates are admitted.
[[nodiscard]] std::vector<std::vector<cdt::Point>> take_away(const std::vector<Contour>& from,
                                                             const std::vector<Contour>& away,
                                                             double z);

}  // namespace loft::io
