// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/mesh.h"
#include "reconstruct/stack.h"

namespace loft::io {

/// A closed contour in space.
struct PlaneContour {
  std::vector<Vec3> points;
  std::size_t material = 1;
  std::string source;
};

/// A plane as the formats of papers have it: a normal of any length, its place along it, which some
/// write with the sign of a x + b y + c z + d = 0 and others without, and the contours in it.
struct ContourPlane {
  Vec3 normal{0, 0, 1};
  double offset = 0;
  std::vector<PlaneContour> contours;
};

/// The stack of parallel planes, whichever way they are turned: level ones keep their coordinates,
/// those across an axis change them round, the others are turned, and the frame leads back
/// (Contour::places are the points as they came). Planes without contours are empty slices, at
/// their offsets, with the sign that those of the others have. Where there are several materials,
/// each is a label, `material 2`. `open_lines` were left out of it.
///
/// Throws InputError where planes are not parallel, with the worst angle.
[[nodiscard]] Stack stack_of_planes(std::vector<ContourPlane> planes, std::size_t open_lines,
                                    std::string_view name);

}  // namespace loft::io
