// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

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

  /// Two contours that run along each other all the way round, within that share of the slice's
  /// width, are one. 0: only those that are the same.
  double tolerance = 1e-7;

  [[nodiscard]] double channel_width(std::span<const cdt::Point> contour) const;
};

/// What closes the first and the last slice.
enum class Cap {
  flat,  ///< the region of the slice itself
  dome,  ///< a rounded end, at most 0.7 of the distance to the next slice high
  open,  ///< nothing: the surface ends in the contours
  /// The region of the slice itself, half a gap further out: slices are slabs, as planning systems
  /// and counts of voxels take them. Empty slices at the ends of a part of the stack count for
  /// nothing. Not for Reconstruction.
  extend,
};

/// Which parts of neighbouring slices the surface joins.
enum class LinkRule {
  automatic,  ///< those that overlap in projection, and those that belong together by their places
  overlap,    ///< those that overlap in projection
  none,       ///< none but those that LinkOrders ask for: every other part ends at half way
};

/// A contour of the input.
struct ContourId {
  std::uint32_t slice = 0;    ///< index in the input
  std::uint32_t contour = 0;  ///< index in its slice

  friend auto operator<=>(const ContourId&, const ContourId&) = default;
};

/// What the user wants of two contours in neighbouring slices: the parts that they bound are
/// linked, or are not.
struct LinkOrder {
  ContourId from;
  ContourId to;
  bool is_link = true;     ///< false: the two must not be linked
  std::string place = {};  ///< where it was given, for messages: `links.ndjson:3`; may be empty
};

struct Options {
  Fill fill = Fill::even_odd;
  std::optional<double> keyhole_width = {};  ///< see Filling
  double tolerance = 1e-7;                   ///< see Filling; not negative
  /// Slices whose heights differ by no more than that share of the least proper gap are one
  /// (find_heights()), for parts whose heights differ by rounding. 0: only those of the same
  /// height. Needs the whole stack: not for Reconstruction.
  double height_tolerance = 0;
  /// Smooths jitter and stairs of contours in their slices first, moving no point by more than
  /// that: see reconstruct/fair.h. Those of all labels at a height are looked at together. Not set
  /// or 0: contours stay as they are.
  std::optional<double> fair = {};
  Cap cap = Cap::flat;
  /// How thick a slice is for Cap::extend, where there is only one.
  std::optional<double> gap = {};
  /// Bends the surface between the slices as their neighbours suggest (reconstruct/shape/smooth.h);
  /// otherwise it is straight from slice to slice.
  bool smooth = false;
  /// With `smooth`: how near the triangles come to the smooth surface, in the unit of the input,
  /// wherever they are not straightened for the sake of others; the smaller, the more there are.
  /// Not set or 0: by what the slices tell, 1.4% of the gap between two of them.
  std::optional<double> smooth_tolerance = {};
  /// Only contours with this label. Not set: all contours, which must have one label then.
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
  LinkRule link = LinkRule::automatic;
  /// The farthest that LinkRule::automatic moves a part sideways from slice to slice, in the unit
  /// of the input, also where that is more than it would by itself; by the parts' size where not
  /// set (link/ends.h). LinkOrders may ask for more.
  std::optional<double> max_shift = {};
  /// Orders that cannot be met are reported among the repairs; the slab is then as without them.
  std::vector<LinkOrder> links = {};
  /// Whether to fill Reconstructed::slabs, or OutOfCoreReport::slabs.
  bool reports_slabs = false;
};

}  // namespace loft
