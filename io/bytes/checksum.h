// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>

namespace loft::io {

/// Of no bytes.
inline constexpr std::uint64_t no_checksum = 0xcbf29ce484222325U;

/// FNV-1a (Fowler, Noll, Vo, 1991) of the bytes behind those that `before` is the checksum of.
[[nodiscard]] constexpr std::uint64_t checksum(std::string_view bytes,
                                               std::uint64_t before = no_checksum) {
  for (const char c : bytes) {
    before ^= static_cast<unsigned char>(c);
    before *= 0x100000001b3U;
  }
  return before;
}

}  // namespace loft::io
