// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace loft::app {

/// Slabs of a part by their ids: all that there are from `first` to `last`.
struct SlabRange {
  std::size_t part = 0;
  std::uint32_t first = 0;
  std::uint32_t last = 0;

  friend bool operator==(const SlabRange&, const SlabRange&) = default;
};

/// Reads `0-17,1-3..65`: slab 17 of part 0, and those from 3 to 65 of part 1. None where it is
/// anything else. Cost: O(n).
[[nodiscard]] std::optional<std::vector<SlabRange>> parse_slab_ranges(std::string_view text);

}  // namespace loft::app
