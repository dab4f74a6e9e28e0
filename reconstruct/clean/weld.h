// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "reconstruct/clean/region.h"
#include "reconstruct/defect.h"

namespace loft {

/// For each point the one to put in its place: of two that are too near to each other one goes, a
/// crossing rather than a point of a contour.
[[nodiscard]] std::vector<std::uint32_t> weld(const Region& region, double least_distance,
                                              std::vector<Defect>& repairs);

}  // namespace loft
