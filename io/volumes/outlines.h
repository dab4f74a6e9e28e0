// SPDX-License-Identifier: MIT
#pragma once

#include "io/stacks/read_options.h"
#include "io/volumes/volume.h"
#include "reconstruct/stack.h"

namespace loft::io {

/// The outlines of all labels of a volume, one slice for each of its slices, in their order; a
/// slice may be without contours.
///
/// Law: by the even-odd rule the outlines of a label enclose the centres of its pixels, and no
/// other centres. An outline never meets itself or another one of its label; those of two labels
/// of one layer may run along each other, but enclose no place both.
///
/// Iso-lines cross from centre to centre of two pixels of which one is inside: half way, or, for a
/// volume with a level, where a straight line between their values meets it (kept 1/64 of the way
/// from the centres). Edges run around the pixels. The world beyond the image is outside. Pixels
/// that meet in a corner only are not joined: there iso-lines keep them apart, and edges have their
/// corner cut off by 1/8 of a pixel. Where two labels are neighbours both have the same line, in
/// opposite directions; iso-lines of three labels that meet between four centres leave a gap there,
/// of at most half a pixel.
///
/// Fair outlines have a point in each square between four pixel centres that they go through, and
/// keep it 1/64 of a pixel or more inside, so that no line comes over a centre. They are about as
/// short as they can be so (reconstruct/fair/relax.h), and enclose the area of their pixels, but
/// for 1e-6 of it; only where many pixels meet in corners may their squares leave no room for that.
/// Shares count for what they are on which side of the level. Labels that are neighbours have the
/// same points on their border, without a gap, also where three meet. Where pixels of a label meet
/// in a corner only, and so do those of another one, the one that comes first in the volume goes
/// through and the other is kept apart; what is outside comes before all.
///
/// If each axis of the pixels runs along one of the world's, slices along z, contours are in the
/// world's coordinates; otherwise they are in its distances along the rows and across them, and the
/// stack has a frame.
///
/// Throws InputError where nothing is inside, where the volume has no spacing and the options none,
/// or its matrix is singular. Cost: O(pixels + labels), memory for a few slices beside the
/// outlines.
[[nodiscard]] Stack trace(const Volume& volume, const ReadOptions& options = {});

}  // namespace loft::io
