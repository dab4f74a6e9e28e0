// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "cdt/point.h"
#include "reconstruct/clean/region.h"

namespace loft {

/// The outlines of a slice at one of its points. A point that they pass twice has the sum of
/// normals, the larger turn and the shortest edge; one on no loop nothing.
struct OutlinePoint {
  cdt::Point facing;  ///< the outward normals of the edges at it, added up
  double turn = 0;    ///< by which the outline turns, radians, without sign
  double edge = 0;    ///< length of the shorter edge
};

/// Of each point of a region.
[[nodiscard]] std::vector<OutlinePoint> outline_points(const Region& region);
/// Of those of two, one after the other.
[[nodiscard]] std::vector<OutlinePoint> outline_points(const Region& lower, const Region& upper);

}  // namespace loft
