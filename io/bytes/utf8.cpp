// SPDX-License-Identifier: MIT
#include "io/bytes/utf8.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace loft::io {

bool is_utf8(std::string_view text) {
  while (!text.empty()) {
    const auto lead = static_cast<std::uint8_t>(text.front());
    const auto length = static_cast<std::size_t>(std::countl_one(lead));
    text.remove_prefix(1);
    if (length == 0) continue;
    if (length == 1 || length > 4 || text.size() < length - 1) return false;

    char32_t character = lead & (0x7fU >> length);
    for (std::size_t i = 1; i < length; ++i) {
      const auto byte = static_cast<std::uint8_t>(text[i - 1]);
      if ((byte & 0xc0U) != 0x80U) return false;
      character = character << 6 | (byte & 0x3fU);
    }
    constexpr char32_t smallest[] = {0x80, 0x800, 0x10000};
    const bool is_surrogate = character >= 0xd800 && character < 0xe000;
    if (character < smallest[length - 2] || character > 0x10ffff || is_surrogate) return false;
    text.remove_prefix(length - 1);
  }
  return true;
}

std::string json_text(std::string text) {
  if (is_utf8(text)) return text;
  std::ranges::replace_if(
      text, [](char c) { return (c & 0x80) != 0; }, '?');
  return text;
}

void append_utf8(std::string& text, char32_t character) {
  const auto add = [&text](char32_t byte) { text += static_cast<char>(byte); };
  const auto add_rest = [&](int count) {
    while (count-- > 0) add(0x80U | ((character >> (6 * count)) & 0x3fU));
  };
  if (character < 0x80) {
    add(character);
  } else if (character < 0x800) {
    add(0xc0U | character >> 6);
    add_rest(1);
  } else if (character < 0x10000) {
    add(0xe0U | character >> 12);
    add_rest(2);
  } else {
    add(0xf0U | character >> 18);
    add_rest(3);
  }
}

}  // namespace loft::io
