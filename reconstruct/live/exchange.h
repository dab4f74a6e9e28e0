// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "reconstruct/live/gaps.h"
#include "reconstruct/live/live_stack.h"
#include "reconstruct/live/surface_change.h"
#include "reconstruct/sew/rim.h"

namespace loft {

/// Puts the slabs that were made into the surface, in the place of those that go, and into the
/// stack. What stays keeps its handles. `rims`: those of slices that are new, as far as they have
/// edges already. What was done is added to `change`.
/// Cost: that of what changes.
void exchange(LiveStack& stack, Gaps& gaps, std::vector<Rim*> rims, SurfaceChange& change);

}  // namespace loft
