// SPDX-License-Identifier: MIT
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "reconstruct/stack.h"

namespace loft::io {

/// Writes a stack as Common Layer Interface 2.0, ASCII: each slice a layer, empty ones too, each
/// label a part, outlines counterclockwise, holes clockwise. `$$UNITS` says how many mm a unit is,
/// coordinates stay as they are. Planes that are tilted in the world are written as if they were
/// level. Returns what CLI cannot hold, one sentence each; see slice_outlines() for what it throws.
std::vector<std::string> write_cli(std::ostream& out, const Stack& stack);

}  // namespace loft::io
