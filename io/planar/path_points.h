// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "cdt/point.h"
#include "paths/path.h"

namespace loft::io {

/// A path as a line, for formats without arcs: chords of an arc are nowhere farther from it than a
/// thousandth of its radius, and their ends lie on it. They come of halving, by square roots alone,
/// so that the same path gives the same points on every machine. No point where there is no path;
/// one where it has no piece.
[[nodiscard]] std::vector<cdt::Point> points_along(const paths::Path& path, cdt::Point from);

}  // namespace loft::io
