// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cdt/point.h"

namespace loft {

/// A channel that was cut: where it left the outline, and what was between its two sides.
struct Channel {
  cdt::Point place;
  double area = 0;
};

/// A closed polygon taken apart at its channels.
struct KeyholeCut {
  /// Indices of the polygon's points, a ring after the other; just one where nothing was cut.
  /// The points of channels, but for their ends, are in none.
  std::vector<std::vector<std::uint32_t>> rings;
  std::vector<Channel> channels;
};

/// Takes the holes out of a polygon that is drawn as one line with them (the keyhole technique of
/// DICOM PS3.3, C.8.8.6.3): a channel leads from the outline to the hole, the same way back.
///
/// A channel is two runs of the polygon in opposite directions that keep within `width` of each
/// other, and within one and a half times of what they are apart where they are nearest. It is
/// longer than wide, and begins and ends with a point on each side, which may be further apart
/// again by half, where outlines are slanted; between, the points of one side may be anywhere along
/// the other. What it joins must be an outline and a hole inside it, or two holes, and both twice
/// as wide as it: parts side by side with a thin bridge, spikes, slits and bays that are hardly
/// wider than their mouth stay as they are.
/// Cost: O(n log n) for each channel, where few points are within `width` of others.
[[nodiscard]] KeyholeCut cut_keyholes(std::span<const cdt::Point> points, double width);

}  // namespace loft
