// SPDX-License-Identifier: MIT
#pragma once

#include "paths/path.h"

namespace loft::paths {

/// The length of a piece. Rounded, by an angle where it turns.
[[nodiscard]] double length(const Piece& piece);

/// The place that has that part of a piece, 0 to 1, behind it. Rounded, by sines where it turns.
[[nodiscard]] Point point_on(const Piece& piece, double part);

/// The place that has that much of a path behind it, for who goes along it at a pace: `from`, where
/// it begins, for less than nothing, and its end beyond its length. Cost: the pieces.
[[nodiscard]] Point point_along(const Path& path, Point from, double distance);

}  // namespace loft::paths
