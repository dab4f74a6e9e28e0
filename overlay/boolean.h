// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "overlay/layer.h"
#include "overlay/polygon.h"

namespace loft::overlay {

/// Boolean operations for those who want one call; who wants several of the same shapes, or moves
/// them, takes an Overlay. Operands are what is inside an odd number of their rings: valid
/// polygons, and any others. Results are as Overlay::polygons() says. Each throws
/// std::invalid_argument if a coordinate is not usable, and costs an Overlay: O(n log n) in
/// practice, plus the crossings.
[[nodiscard]] MultiPolygon unite(const MultiPolygon& a, const MultiPolygon& b);
[[nodiscard]] MultiPolygon intersect(const MultiPolygon& a, const MultiPolygon& b);
[[nodiscard]] MultiPolygon subtract(const MultiPolygon& a, const MultiPolygon& b);
/// What is in one of them alone.
[[nodiscard]] MultiPolygon exclude(const MultiPolygon& a, const MultiPolygon& b);
/// The union of many.
[[nodiscard]] MultiPolygon dissolve(std::span<const MultiPolygon> many);
/// What some rings enclose by a rule.
[[nodiscard]] MultiPolygon fill(std::span<const Ring> rings, FillRule rule);

}  // namespace loft::overlay
