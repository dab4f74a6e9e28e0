// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "reconstruct/clean/region.h"
#include "reconstruct/options.h"
#include "reconstruct/slice.h"

namespace loft::stacks {

/// By how much the area of a region is off that of the contours it was made from, relative to the
/// square of their extent; in rational arithmetic unless it is below 1e-14 in any case: what is
/// inside is told strip by strip, between all heights where sides begin, end or cross.
/// Precondition: fill is even_odd or nonzero.
/// Cost: O(n^3).
[[nodiscard]] double area_error(const Region& region, std::span<const Contour> contours, Fill fill);

}  // namespace loft::stacks
