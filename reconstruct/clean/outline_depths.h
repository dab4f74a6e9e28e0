// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cdt/point.h"

namespace loft {

/// What encloses an outline: how many others, and how often these go around it to the left.
struct OutlineDepth {
  int depth = 0;
  int winding = 0;
};

/// A simple outline that neither meets nor touches others.
struct SimpleOutline {
  std::span<const cdt::Point> points;
  bool turns_left = true;
};

/// The depth of each outline, by a line that sweeps over them from left to right (exact). Cost:
/// O(n log n), however they are nested.
[[nodiscard]] std::vector<OutlineDepth> outline_depths(std::span<const SimpleOutline> outlines);

}  // namespace loft
