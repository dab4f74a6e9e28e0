// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

namespace loft {

/// What is inside the contours of one slice.
enum class Fill {
  even_odd,  ///< a point enclosed by an odd number of contours: nested contours are holes
  nonzero,   ///< a point that contours wind around: overlapping ones make their union
};

/// What closes the first and the last slice.
enum class Cap {
  flat,  ///< the region of the slice itself
  dome,  ///< a rounded end, at most 0.7 of the distance to the next slice high
  open,  ///< nothing: the surface ends in the contours
};

struct Options {
  Fill fill = Fill::even_odd;
  Cap cap = Cap::flat;
  /// Bends the surface between the slices as their neighbours suggest (reconstruct/smooth.h);
  /// otherwise it is straight from slice to slice.
  bool smooth = false;
  /// Only contours with this label; all contours where not set.
  std::optional<std::string> label = {};
  /// Threads that work at the same time; 0: as many as the machine has. Changes nothing but time.
  unsigned threads = 0;
};

}  // namespace loft
