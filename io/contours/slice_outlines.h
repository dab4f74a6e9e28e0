// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "reconstruct/clean/region.h"
#include "reconstruct/stack.h"

namespace loft::io {

/// What a label encloses in a slice.
struct LabelRegion {
  std::string label;
  Region region;
};

/// What each label encloses in a slice of a stack, sorted by label, by the stack's fill rule
/// (even-odd where it has none): for formats in which it is the direction of an outline, or what is
/// on its sides, that says what is inside. Contours that meet nothing keep their points. Throws
/// InputError where a coordinate is none.
[[nodiscard]] std::vector<LabelRegion> slice_outlines(const Stack& stack, std::uint32_t slice);

}  // namespace loft::io
