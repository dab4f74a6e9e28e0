// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "reconstruct/clean/cleaning.h"
#include "reconstruct/clean/region.h"
#include "reconstruct/defect.h"

namespace loft {

/// Adds contours without an area, `flat` among `contours`, to a region as lines. Those that lie in
/// the region or touch it, repeat or cross one another are dropped and reported: the first ones
/// by their places stay, lines before points, so that the order of contours does not matter.
/// What is nearer than twice `least_distance` touches. Cost: O(n log n) in practice.
void add_lines(Region& region, std::span<const ContourSource> contours,
               std::span<const std::uint32_t> flat, double least_distance,
               std::vector<Defect>& repairs);

/// The report that a contour without an area is dropped: `places` different points, one of them
/// `place`; and why.
[[nodiscard]] Defect dropped_line(double z, std::uint32_t slice, std::uint32_t contour,
                                  std::size_t places, const char* why);

/// The same of a region's line that no part ends in.
[[nodiscard]] Defect unused_line(const Region& region, std::size_t line);

}  // namespace loft
