// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstdint>

namespace loft::cdt {

/// Blocks of segments come in sizes that grow by a quarter at most, so that those of removed
/// constraints fit others.
struct SizeClass {
  std::uint32_t index;
  std::uint32_t size;
};

inline constexpr std::uint32_t size_classes = 8 + 4 * 32;

/// The smallest that holds so many.
[[nodiscard]] constexpr SizeClass size_class(std::uint32_t count) {
  if (count <= 8) return {count, count};
  const auto shift = static_cast<std::uint32_t>(std::bit_width(count - 1)) - 3;
  const std::uint32_t quarters = (count - 1) >> shift;  // 4 ... 7
  return {8 + 4 * (shift - 1) + (quarters - 3), (quarters + 1) << shift};
}

/// The size of blocks of a class.
[[nodiscard]] constexpr std::uint64_t size_of_class(std::uint32_t index) {
  if (index <= 8) return index;
  return std::uint64_t{(index - 9) % 4 + 5} << ((index - 9) / 4 + 1);
}

}  // namespace loft::cdt
