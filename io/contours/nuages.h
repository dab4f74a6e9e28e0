// SPDX-License-Identifier: MIT
#pragma once

#include "io/stacks/stack_format.h"

namespace loft::io {

/// Reads `.cnt` of Nuages: `S` and a count of sections; of each `v` and a count of vertices, `z`
/// and its height, then its contours, points `x y` in braces.
[[nodiscard]] Stack read_nuages(const StackInput& input, const ReadOptions& options);

}  // namespace loft::io
