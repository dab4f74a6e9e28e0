// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace loft::io {

/// What rounding to `float` does to surfaces, and what was done about it. Faults: faces without
/// area, pairs of faces that meet, and vertices that share a place, as who reads a file by its
/// places joins them.
struct Rounding {
  std::size_t faults = 0;     ///< that there were
  std::size_t moved = 0;      ///< vertices that went to a neighbouring `float`
  std::size_t collapsed = 0;  ///< edges that are gone
  std::size_t left = 0;       ///< faults that there still are

  friend bool operator==(const Rounding&, const Rounding&) = default;
};

}  // namespace loft::io
