// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "reconstruct/stack.h"

namespace loft::io {

/// `#rrggbb`
[[nodiscard]] inline std::string hexadecimal(Colour colour) {
  constexpr std::string_view digits = "0123456789abcdef";
  std::string text = "#";
  for (const unsigned share : {colour.red, colour.green, colour.blue}) {
    text += digits[share / 16];
    text += digits[share % 16];
  }
  return text;
}

/// All 16 digits.
[[nodiscard]] inline std::string hexadecimal(std::uint64_t number) {
  std::string text;
  for (int shift = 60; shift >= 0; shift -= 4)
    text += "0123456789abcdef"[(number >> static_cast<unsigned>(shift)) & 15U];
  return text;
}

}  // namespace loft::io
