// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "cdt/point.h"

namespace loft {

/// A closed polygon in a slice, as it came in; the last point joins the first. Its orientation
/// means nothing, and nothing is asked of it: cleaning sorts out what it encloses.
struct Contour {
  std::vector<cdt::Point> points;
  std::string label = {};  ///< the structure it belongs to; empty where the stack has no labels
  /// Where it comes from in its file, as messages say it: `ROI 3 contour 12`; may be empty.
  std::string source = {};
  /// Where its points are in the world, as the file has them, where a WorldFrame would only come
  /// near; none where it gives the same, or there is no frame. As many as there are points.
  std::vector<std::array<double, 3>> places = {};

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
