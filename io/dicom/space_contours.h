// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "io/bytes/problems.h"
#include "mesh/mesh.h"
#include "reconstruct/stack.h"

namespace loft::io {

/// A closed line in space that should be in a plane, as files have it that give three coordinates
/// for each point. Three points at least.
struct SpaceContour {
  std::vector<Vec3> points;
  std::string label;
  std::string source;  ///< as Contour::source
};

/// Makes them the slices of a stack, in ascending order, contours of a slice in the order given.
///
/// If all are in planes of constant z, x or y, contours keep the other two coordinates as they are
/// (for x and y the frame says which they are). Otherwise one plane direction is fitted to all: the
/// stack has its frame, and contours their places. Planes that differ by rounding are one: by no
/// more than a hundredth of the median gap, at the height most of them have; a note says so.
///
/// Adds a problem for each contour that is not flat, or not parallel to the others, with the
/// angle; the stack has no slices then. Cost: O(n log n).
void into_slices(std::vector<SpaceContour>&& contours, std::string_view name, Stack& stack,
                 Problems& problems);

}  // namespace loft::io
