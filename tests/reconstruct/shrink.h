// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "reconstruct/slice.h"

namespace loft::stacks {

/// Whether a stack shows the failure that is looked into.
using Fails = std::function<bool(const std::vector<Slice>&)>;

/// A stack as small as can be had that still fails: contours and points left out, coordinates
/// rounded, one thing after the other as long as that helps. Precondition: `slices` fails.
[[nodiscard]] std::vector<Slice> shrink(std::vector<Slice> slices, const Fails& fails);

/// The stack as C++, ready to paste into a test.
[[nodiscard]] std::string as_code(const std::vector<Slice>& slices);

}  // namespace loft::stacks
