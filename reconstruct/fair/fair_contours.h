// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "cdt/point.h"
#include "reconstruct/slice.h"

namespace loft {

/// The contours of one slice with jitter and stairs smoothed: the same contours, with their points
/// moved. Laws: no point moves by more than `distance`; no two edges meet that did not, nor does
/// anything come out of what it was in; the area of each contour stays, but for 1e-4 of it at most;
/// points that are equal stay so. Edges that meet, but for their ends, keep their place, and so do
/// contours that enclose nothing. The result depends neither on the order of the contours nor on
/// where their points begin and which way they go round.
///
/// Contours with coordinates that are not admitted (mesh/admitted.h) are left as they are.
/// Precondition: the distance is. Cost: O(n log n) where few edges are near each other.
[[nodiscard]] std::vector<std::vector<cdt::Point>> fair(
    std::span<const std::span<const cdt::Point>> contours, double distance);

/// The same in place, for the contours of slices of one height.
void make_fair(std::span<Slice* const> parts, double distance);

}  // namespace loft
