// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "reconstruct/stack.h"

namespace loft::io {

/// Adds what one more file has to a stack: slices, labels that are new, notes. The first file
/// decides unit, frame and fill rule; throws InputError, which names the file, where it differs.
void join(Stack& whole, Stack&& part, const std::string& file, bool is_first);

}  // namespace loft::io
