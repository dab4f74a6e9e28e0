// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cdt/point.h"
#include "cdt/triangulation.h"
#include "reconstruct/clean/region.h"
#include "reconstruct/defect.h"
#include "reconstruct/options.h"

namespace loft {

/// A contour on its way into cleaning: its points, and where it stands in the input.
struct ContourSource {
  std::span<const cdt::Point> points;
  std::uint32_t slice = 0;
  std::uint32_t contour = 0;
};

/// Cleans a slice: copies of contours are
/// dropped, keyholes cut; those that have an area go into a CDT, which is flooded by the fill rule;
/// the edges between inside and outside make the loops. The others become lines (add_lines()). What
/// was found is appended to `repairs`. Laws: a slice of which nothing is reported keeps its
/// vertices and edges, one for one. The region does not depend on the order of the contours and of
/// their points; with even-odd filling neither on their direction. Precondition: finite
/// coordinates. Cost: that of the CDT; where contours meet, with how many enclose the same place.
[[nodiscard]] Region clean(std::span<const ContourSource> contours, double z,
                           const Filling& filling, std::vector<Defect>& repairs);
/// The same with memory for the CDT that can be used again from slice to slice.
[[nodiscard]] Region clean(std::span<const ContourSource> contours, double z,
                           const Filling& filling, std::vector<Defect>& repairs,
                           cdt::Triangulation& memory);

}  // namespace loft
