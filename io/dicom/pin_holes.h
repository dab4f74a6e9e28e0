// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include "io/dicom/space_contours.h"

namespace loft::io {

/// The channels that were closed, and how far their sides are from each other.
struct PinHoles {
  std::size_t count = 0;
  double width = 0;
};

/// Closes channels from holes to the outline as rt-utils draws them (`use_pin_hole`). It blanks a
/// line of pixels along y from each hole, three of them wide, until something is outside, and leads
/// outlines through the centres of the pixels that are left: the sides are four pixels apart.
///
/// Two sides are a channel's if they are straight, along y, in opposite directions, four pixels
/// apart, alongside each other for longer than that, with nothing between them, which is outside by
/// the even-odd rule. Where several lines are side by side it may be up to twice as wide, but has
/// to be 1.5 times as long. Sides are taken out; the ends are closed from corner to corner, or
/// straight across where a side goes on by more than four pixels. Both sides may be of one contour,
/// which leaves an outline and a hole, or of two, which become one. Holes that are long and narrow
/// themselves stay.
///
/// `contours` are those of one structure, of three points or more, or of two, which rt-utils draws
/// around a row of pixels; what is left of less than three is for the caller to drop. Those of one
/// z are a slice; others are not looked at. Contours without such a channel stay as they are;
/// others end up behind them, with all points but those between the ends of channels. Does nothing
/// where points are not on a lattice of pixels. Cost: O(n log n); what would take more than 2000
/// steps a point stays as drawn.
PinHoles close_pin_holes(std::vector<SpaceContour>& contours);

}  // namespace loft::io
