// SPDX-License-Identifier: MIT
#pragma once

#include <iosfwd>

#include "fields/raster.h"

namespace loft::io {

/// Writes an ESRI ASCII grid (Arc/Info ASCII): a header, then the rows from the top down. Its cells
/// are squares around the grid's places. Numbers have as many digits as it takes to read them back
/// exactly; where there is no value it says -9999, or, if a value is that, another number below
/// all. Precondition: the steps are one length, in y downwards. Cost: that of rasterize(), twice.
void write_ascii_grid(std::ostream& out, const fields::Field& field, const fields::Grid& grid,
                      fields::Smoothness smoothness);

}  // namespace loft::io
