// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
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

/// The points of all its contours.
[[nodiscard]] inline std::size_t point_count(const Slice& slice) {
  std::size_t count = 0;
  for (const Contour& contour : slice.contours) count += contour.points.size();
  return count;
}

}  // namespace loft
