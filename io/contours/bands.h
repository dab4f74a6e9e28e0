// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>
#include <vector>

#include "cdt/point.h"
#include "reconstruct/slice.h"

namespace loft::io {

/// A ring of the region between two heights; its first point is not repeated.
struct BandRing {
  std::vector<cdt::Point> points;
  double z = 0;  ///< the lower one
};

/// The slices of a terrain that is drawn as bands: at each height the outlines of this band and all
/// above it, as bands that meet share their edges, which fall away. Cost: O(n log n), and as much
/// as comes out. Throws InputError that names `name` where that is more than a hundred times what
/// goes in: no terrain is like that.
[[nodiscard]] std::vector<Slice> sum_bands(const std::vector<BandRing>& rings,
                                           std::string_view name);

}  // namespace loft::io
