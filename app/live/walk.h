// SPDX-License-Identifier: MIT
#pragma once

#include "paths/path.h"

namespace loft::app {

/// The point of a path that has that much of it behind it: `from`, where it begins, for less than
/// nothing, and its end beyond its length. Rounded, by sines where it turns.
[[nodiscard]] cdt::Point point_along(const paths::Path& path, cdt::Point from, double distance);

}  // namespace loft::app
