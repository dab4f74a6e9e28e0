// SPDX-License-Identifier: MIT
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "reconstruct/stack.h"

namespace loft::io {

/// Writes a stack as `.contour` (Ju and others): planes in the world, from below, a x + b y + c z +
/// d = 0, each with its vertices, and edges with what is on their left and right: a label's number,
/// from 1, or 0. Edges that two labels share are there once. Returns what the format cannot hold,
/// one sentence each; see slice_outlines() for what it throws.
std::vector<std::string> write_contour(std::ostream& out, const Stack& stack);

}  // namespace loft::io
