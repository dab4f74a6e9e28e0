// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "cdt/point.h"

namespace loft {

/// What was found wrong with the input.
enum class DefectKind {
  not_finite,        ///< a coordinate or height is not in its range (mesh/admitted.h); fatal
  slices_too_near,   ///< less than 2^-40 of their height apart: rounding leaves no room; fatal
  too_few_slices,    ///< fewer than two slices with something in them; fatal
  too_few_points,    ///< a contour of 0, 1 or 2 points, or of fewer than 3 different ones: dropped
  zero_area,         ///< a contour whose points are all in one line: dropped
  repeated_contour,  ///< the same contour twice in a slice, or one that goes round twice: one kept
  repeated_point,    ///< the same point twice in a row: one copy dropped
  spike,             ///< an out-and-back piece without area: removed
  keyhole,           ///< a hole joined to its outline by a channel: cut (--fill keyhole-aware)
  self_crossing,     ///< a contour crosses or overlaps itself: resolved by the fill rule
  overlap,           ///< two contours of a slice cross or overlap: resolved by the fill rule
  covered,           ///< a contour that winding numbers make no hole: without effect
  touching,          ///< a shared side, or a corner on a side: joined, or the side split there
  empty_slice,       ///< a slice without contours between others: the shape ends and starts again
  merged_slices,     ///< two slices of the same height: merged into one
  unlinked_slices,   ///< no valid surface was found between two slices: both end half way
  off_plane,         ///< points of tilted slices are too far off their planes: moved there
  refused_link,      ///< an order to link or not to link contours could not be met
};

/// The kind's name as reports print it, for example `self_crossing`.
[[nodiscard]] const char* name(DefectKind kind);

/// One thing that is or was wrong with the input, and where.
struct Defect {
  DefectKind kind;
  double z = 0;                               ///< height of the slice
  std::uint32_t slice = 0;                    ///< index of the slice in the order of the input
  std::optional<std::uint32_t> contour = {};  ///< index in its slice
  std::optional<std::uint32_t> point = {};    ///< index in its contour
  std::optional<cdt::Point> place = {};       ///< where in the slice
  /// How much of the slice the repair decided, in square units: what both contours of an overlap
  /// enclose, what a self-crossing one winds around twice or backwards, a covered contour, a
  /// channel. 0 where only lines were left out.
  double area = 0;
  std::string message = {};  ///< what is wrong and the way out, without the place
};

/// `slice 42 (z = 10.5) contour 3 point 7 near (12.1, 40.7): message`, as far as known.
[[nodiscard]] std::string describe(const Defect& defect);

/// Base of every exception that loft throws on purpose.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The input cannot be worked on. Carries every fatal defect, not just the first;
/// what() lists them, one a line.
class InputError : public Error {
 public:
  explicit InputError(std::vector<Defect> defects);
  explicit InputError(const std::string& what) : Error(what) {}

  [[nodiscard]] const std::vector<Defect>& defects() const { return defects_; }

 private:
  std::vector<Defect> defects_;
};

/// Whether all that is wrong is that there is not enough of it: such labels stop no others.
[[nodiscard]] bool is_too_little(const InputError& error);

}  // namespace loft
