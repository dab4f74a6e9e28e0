// SPDX-License-Identifier: MIT
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "reconstruct/stack.h"

namespace loft::io {

/// Writes a stack as CSV (RFC 4180) with the columns x, y, z (in the world), contour, label; exact.
/// Returns what CSV cannot hold, one sentence each.
std::vector<std::string> write_csv(std::ostream& out, const Stack& stack);

}  // namespace loft::io
