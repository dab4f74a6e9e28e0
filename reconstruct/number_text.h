// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <charconv>
#include <concepts>
#include <string>

namespace loft {

/// Appends a number with as few digits as give it back exactly; never depends on the locale.
template <class Number>
requires std::integral<Number> || std::floating_point<Number>
void append_number(std::string& text, Number number) {
  std::array<char, 32> digits;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr;
  text.append(digits.data(), end);
}

/// The shortest text that gives the number back exactly.
[[nodiscard]] inline std::string exact(double number) {
  std::string text;
  append_number(text, number);
  return text;
}

}  // namespace loft
