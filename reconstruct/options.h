// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>
#include <string>

#include "cdt/point.h"

namespace loft {

/// What is inside the contours of one slice.
enum class Fill {
  even_odd,  ///< a point enclosed by an odd number of contours: nested contours are holes
  nonzero,   ///< a point that contours wind around: overlapping ones make their union
  /// As even_odd, once holes have been taken out of the contours that lead through a channel to
  /// them and back (the keyhole technique of DICOM): an even-odd slit in their place is closed.
  keyhole_aware,
};

/// A fill rule and what it needs to know.
struct Filling {
  Fill rule = Fill::even_odd;
  /// Keyhole-aware: how far the sides of a channel may be from each other, in the units of the
  /// input. Not set: a thousandth of the diagonal of the contour's box, half a millimetre for the
  /// outline of a body.
  std::optional<double> keyhole_width = {};

  [[nodiscard]] double channel_width(std::span<const cdt::Point> contour) const;
};

/// What closes the first and the last slice.
enum class Cap {
  flat,  ///< the region of the slice itself
  dome,  ///< a rounded end, at most 0.7 of the distance to the next slice high
  open,  ///< nothing: the surface ends in the contours
};

struct Options {
  Fill fill = Fill::even_odd;
  std::optional<double> keyhole_width = {};  ///< see Filling
  Cap cap = Cap::flat;
  /// Bends the surface between the slices as their neighbours suggest (reconstruct/smooth.h);
  /// otherwise it is straight from slice to slice.
  bool smooth = false;
  /// Only contours with this label; all contours where not set.
  std::optional<std::string> label = {};
  /// Threads that work at the same time; 0: as many as the machine has. Changes nothing but time.
  unsigned threads = 0;
  /// Splits inner edges of slabs that are longer: see split_long_edges(). Positive.
  std::optional<double> max_edge = {};
  /// Brings inner edges of slabs near that length, with better angles: see even_out_edges().
  /// Positive; not with max_edge.
  std::optional<double> target_edge = {};
  /// Removes vertices as long as the surface moves by no more than that: see simplify(). Not
  /// negative; not with max_edge or target_edge.
  std::optional<double> simplify = {};
};

}  // namespace loft
