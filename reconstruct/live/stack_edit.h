// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include "reconstruct/live/live_stack.h"
#include "reconstruct/live/surface_change.h"
#include "reconstruct/slice.h"

namespace loft {

/// What is at a height from then on, if anything.
struct SliceEdit {
  double z = 0;
  std::shared_ptr<const Slice> slice = {};
  bool is_merged = false;  ///< with contours that were there
};

/// Applies edits, each at another height, as one. Strong guarantee: throws InputError with all that
/// is wrong before anything has changed. Cost: that of the slabs beside the slices, and a little
/// for each slab between the lowest and the highest of them.
SurfaceChange apply(LiveStack& stack, std::vector<SliceEdit> edits);

}  // namespace loft
