// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "reconstruct/gaps.h"
#include "reconstruct/live_stack.h"
#include "reconstruct/rim.h"
#include "reconstruct/surface_change.h"

namespace loft {

/// Puts the slabs that were made into the surface, in the place of those that go, and into the
/// stack. What stays keeps its handles. `rims`: those of slices that are new, as far as they have
/// edges already. What was done is added to `change`.
/// Cost: that of what changes.
void exchange(LiveStack& stack, Gaps& gaps, std::vector<Rim*> rims, SurfaceChange& change);

}  // namespace loft
