// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>

#include "reconstruct/clean/cleaning.h"
#include "reconstruct/clean/region.h"
#include "reconstruct/options.h"

namespace loft {

/// The region of a slice that has nothing to clean: contours that do not come as near as
/// `least_distance` to one another or, beside their corners, to themselves, and each of which the
/// rule makes a boundary. None for all others, and for keyholes.
/// The loops are in the order of their smallest points, and begin with them.
/// Precondition: finite coordinates. Cost: O(n) in practice, a small part of that of a CDT; O(n log
/// n) where contours are nested or long edges run side by side.
[[nodiscard]] std::optional<Region> simple_region(std::span<const ContourSource> contours, double z,
                                                  Fill rule, double least_distance);

}  // namespace loft
