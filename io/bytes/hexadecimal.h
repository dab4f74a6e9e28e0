// SPDX-License-Identifier: MIT
#pragma once

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

}  // namespace loft::io
