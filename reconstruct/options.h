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
  /// Only contours with this label; all contours where not set.
  std::optional<std::string> label = {};
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
