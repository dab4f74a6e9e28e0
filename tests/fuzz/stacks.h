// SPDX-License-Identifier: MIT
// What fuzz targets of readers of stacks have in common.
#pragma once

#include <cmath>
#include <string>

#include "io/stacks/stack_format.h"
#include "tests/fuzz/target.h"

namespace loft::fuzz {

inline void use(const Contour& contour) {
  require(contour.points.size() >= 3, "a contour of fewer than three points");
  require(contour.places.empty() || contour.places.size() == contour.points.size(),
          "not a place for each point");
  for (const cdt::Point& point : contour.points)
    require(std::isfinite(point.x) && std::isfinite(point.y), "a point that is no place");
}

inline void use(const Stack& stack) {
  for (const Slice& slice : stack.slices)
    for (const Contour& contour : slice.contours) use(contour);
  require(!stack.frame || fault(*stack.frame).empty(), "a frame that cannot be used");
}

/// Reads any bytes: a stack comes out whose slices ascend, or words.
inline void read_stack(Stack (*read)(const io::StackInput&, const io::ReadOptions&),
                       const std::string& bytes, const io::ReadOptions& options = {}) {
  try_to([&] {
    const Stack stack = read({bytes, "a.file"}, options);
    use(stack);
    bool has_contour = false;
    for (std::size_t i = 0; i < stack.slices.size(); ++i) {
      require(i == 0 || stack.slices[i - 1].z < stack.slices[i].z, "slices that do not ascend");
      has_contour = has_contour || !stack.slices[i].contours.empty();
    }
    require(has_contour, "a stack without contours");
  });
}

/// The same of formats whose slices may descend, and be empty.
inline void read_volume(Stack (*read)(const io::StackInput&, const io::ReadOptions&),
                        const std::string& bytes) {
  try_to([&] {
    const Stack stack = read({bytes, "a.file"}, {});
    require(!stack.slices.empty(), "a stack without slices");
    use(stack);
  });
}

}  // namespace loft::fuzz
