// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "io/stacks/stack_format.h"

namespace loft::io {

/// Reads GeoJSON with heights: isolines, polygons, or the bands between two heights.
///
/// Heights are ReadOptions::z_property; or the third coordinates, unless they are all the same; or
/// the first of the properties `ELEV`, `elev`, `elevation`, `height`, `z`, `CONTOUR` that is there,
/// and a note says which. Bands are polygons with `EMIN` or `ELEV_MIN` (gdal_contour -p): a slice
/// is what is in this band or a higher one. The property `label` is the label.
///
/// Isolines that end are refused, with their number, unless ReadOptions::open_lines closes them
/// along the box of the data (close_along_border()). Degrees are refused: heights are not.
[[nodiscard]] Stack read_terrain(const StackInput& input, const ReadOptions& options);

/// Whether a file begins as a collection of features does.
[[nodiscard]] bool begins_like_terrain(std::string_view bytes);

}  // namespace loft::io
