// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "reconstruct/options.h"
#include "reconstruct/slice.h"
#include "reconstruct/stack.h"

namespace loft {

/// What Options::fair makes of slices before anything else: the same contours with their jitter and
/// stairs smoothed, those of one height together, whatever their labels. Laws: no point moves by
/// more than `distance`, nor out of its slice; no two edges of a height meet that did not, nor does
/// anything come out of what it was in; the area of each contour stays, but for 1e-4 of it at most;
/// equal points stay equal, so what touches goes on to touch. Edges that meet elsewhere than in
/// their ends keep their place, and so do contours that enclose nothing. What becomes of a height
/// depends on it alone, and neither on the order of its contours nor on where their points begin
/// and which way they go round; nor on the number of threads.
///
/// `height_tolerance`: as in Options. Precondition: heights and distance are admitted
/// (mesh/admitted.h); contours with coordinates that are not are left as they are. Throws
/// InputError as find_heights(). Cost: that of cleaning, about.
[[nodiscard]] std::vector<Slice> fair(std::span<const Slice> slices, double distance,
                                      double height_tolerance = 0, unsigned threads = 0);

/// The same for a stack, all of whose slices must be usable: throws InputError that names all that
/// is not. Its contours' own places in the world are left out: its frame has them.
[[nodiscard]] Stack fair(const Stack& stack, double distance, double height_tolerance = 0,
                         unsigned threads = 0);

}  // namespace loft
