// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "cdt/point.h"

namespace loft {

/// A closed polygon in a slice, as it came in; the last point joins the first. Its orientation
/// means nothing, and nothing is asked of it: cleaning sorts out what it encloses.
struct Contour {
  std::vector<cdt::Point> points;
  std::string label;  ///< the structure it belongs to; empty where the stack has no labels

  friend bool operator==(const Contour&, const Contour&) = default;
};

/// A height and the contours in it, in the units of the input.
struct Slice {
  double z = 0;
  std::vector<Contour> contours;

  friend bool operator==(const Slice&, const Slice&) = default;
};

}  // namespace loft
