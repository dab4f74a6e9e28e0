// SPDX-License-Identifier: MIT
#pragma once

#include <ostream>
#include <span>
#include <string_view>
#include <vector>

#include "io/planar/polyline.h"

namespace loft::io {

/// Polylines as plain text: for each one a line `n closed`, closed being 0 or 1, then n lines `x
/// y`. Blank lines are ignored, and so is what stands behind a `#`. There are no names.
///
/// Throws InputError that names `name` and line of each bad place. Cost: O(n).
[[nodiscard]] std::vector<Polyline> read_polylines_text(std::string_view text,
                                                        std::string_view name);

/// Writes polylines so that read_polylines_text() gives them back, exactly; names are lost.
/// Precondition: all numbers are finite, every polyline has a point.
void write_polylines_text(std::ostream& out, std::span<const Polyline> polylines);

}  // namespace loft::io
