// SPDX-License-Identifier: MIT
#pragma once

#include <set>
#include <string>
#include <vector>

#include "cdt/triangulation.h"
#include "reconstruct/clean/heights.h"
#include "reconstruct/clean/region.h"
#include "reconstruct/defect.h"
#include "reconstruct/options.h"
#include "reconstruct/out_of_core/slice_source.h"

namespace loft {

/// The slices at a height, cleaned. Adds what was repaired, and the labels of the contours unless
/// Options::label chooses one. Throws InputError of what cannot be used. `memory` is used again.
[[nodiscard]] Region read_region(const SliceSource& source, const Height& height,
                                 const Options& options, std::vector<Defect>& repairs,
                                 std::set<std::string>& labels, cdt::Triangulation& memory);

/// The z of all slices. Throws InputError of those that are none.
[[nodiscard]] std::vector<double> usable_heights(const SliceSource& source);

}  // namespace loft
