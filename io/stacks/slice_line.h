// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "reconstruct/slice.h"

namespace loft::io {

/// What one line of a stack file says, and everything that is wrong with it.
struct SliceLine {
  Slice slice;
  /// One sentence each, with its place in the slice: `contour 0 point 4: NaN is not a number`.
  std::vector<std::string> problems;
  std::optional<double> z;  ///< the slice's height, if it could be read
};

/// Reads one line of NDJSON as a slice. Cost: O(n), no document tree is built.
[[nodiscard]] SliceLine parse_slice_line(std::string_view line);

}  // namespace loft::io
