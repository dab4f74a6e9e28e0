// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <charconv>
#include <cstddef>
#include <string>
#include <string_view>

namespace loft::io {

/// The text without the byte order mark that some programs put in front.
[[nodiscard]] constexpr std::string_view without_mark(std::string_view text) {
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
  return text;
}

/// The text with every control character replaced, so that it stays on its line of a file.
[[nodiscard]] inline std::string one_line(std::string_view text) {
  std::string result(text);
  for (char& c : result) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '_';
  }
  return result;
}

[[nodiscard]] constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// A word of a file as messages show it: in quotes, on one line, not too much of it.
[[nodiscard]] inline std::string in_quotes(std::string_view word) {
  constexpr std::size_t enough = 40;
  std::string result(1, '\'');
  result += one_line(word.substr(0, enough));
  result += word.size() > enough ? "...'" : "'";
  return result;
}

/// A length or an angle as messages show it: with three digits.
[[nodiscard]] inline std::string short_number(double value) {
  constexpr int digits = 3;
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value,
                                 std::chars_format::general, digits);
  return {text.data(), end.ptr};
}

}  // namespace loft::io
