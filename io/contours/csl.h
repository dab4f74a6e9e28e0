// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "io/stacks/stack_format.h"

namespace loft::io {

/// Reads `.csl` (Bermano and others): planes, each with its vertices and closed components, which
/// have a material; a hole, `12h0` in component 0, has that of its outline. See stack_of_planes().
[[nodiscard]] Stack read_csl(const StackInput& input, const ReadOptions& options);
[[nodiscard]] bool begins_like_csl(std::string_view bytes);

/// Reads `.contour` (Ju and others): planes, each with its vertices, and edges between two
/// materials, 0 being outside: the boundary of each material is joined of its edges.
[[nodiscard]] Stack read_contour(const StackInput& input, const ReadOptions& options);

}  // namespace loft::io
