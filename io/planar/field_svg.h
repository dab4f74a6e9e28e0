// SPDX-License-Identifier: MIT
#pragma once

#include <iosfwd>
#include <span>
#include <vector>

#include "fields/field.h"

namespace loft::io {

/// A picture of values over the plane.
struct FieldPicture {
  const fields::Field* field = nullptr;
  std::vector<double> levels = {};  ///< rising; between two of them there is one colour
  bool has_samples = true;
  bool has_triangles = false;
};

/// Draws the bands between levels, isolines, and the lines of the field, each kind in a way of its
/// own: walls are drawn through, barriers dashed, features fine, soft lines dotted. Coordinates are
/// rounded to hundredths of a pixel. The same field gives the same bytes. Cost: that of
/// fields::bands().
void write_field_svg(std::ostream& out, const FieldPicture& picture, double width = 1200);

}  // namespace loft::io
