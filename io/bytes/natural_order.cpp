// SPDX-License-Identifier: MIT
#include "io/bytes/natural_order.h"

#include <algorithm>
#include <string>
#include <tuple>

#include "io/bytes/text.h"

namespace loft::io {

namespace {

/// Takes the digits in front of a text, without leading zeros.
std::string_view take_number(std::string_view& text) {
  const auto begin = std::min(text.find_first_not_of('0'), text.size());
  text.remove_prefix(begin);
  const auto end =
      static_cast<std::size_t>(std::ranges::find_if_not(text, is_digit) - text.begin());
  const std::string_view digits = text.substr(0, end);
  text.remove_prefix(end);
  return digits;
}

/// Below 0, 0 or above 0, as a is before, equal to, or behind b.
int compare(std::string_view a, std::string_view b) {
  while (!a.empty() && !b.empty()) {
    if (is_digit(a[0]) && is_digit(b[0])) {
      const std::string_view m = take_number(a);
      const std::string_view n = take_number(b);
      if (m.size() != n.size()) return m.size() < n.size() ? -1 : 1;
      if (const int order = m.compare(n); order != 0) return order;
      continue;
    }
    if (a[0] != b[0])
      return static_cast<unsigned char>(a[0]) < static_cast<unsigned char>(b[0]) ? -1 : 1;
    a.remove_prefix(1);
    b.remove_prefix(1);
  }
  return static_cast<int>(!a.empty()) - static_cast<int>(!b.empty());
}

}  // namespace

bool in_natural_order(const std::filesystem::path& a, const std::filesystem::path& b) {
  const std::string first = a.string();
  const std::string second = b.string();
  const int order = compare(first, second);
  return order != 0 ? order < 0 : first < second;
}

}  // namespace loft::io
