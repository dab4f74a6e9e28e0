// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "reconstruct/slice.h"

namespace loft {

/// A stack that is not in memory.
struct SliceSource {
  struct Entry {
    double z = 0;
    std::size_t points = 0;  ///< about: so that pieces of work are of one size
  };
  std::vector<Entry> slices;  ///< in the order of the input
  /// Slice i. Called by several threads at once; exceptions are passed on.
  std::function<Slice(std::uint32_t i)> read;
};

}  // namespace loft
