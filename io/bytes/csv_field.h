// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

namespace loft::io {

/// A text as a field of CSV (RFC 4180).
[[nodiscard]] inline std::string csv_field(std::string_view text) {
  if (text.find_first_of(",\"\n\r") == std::string_view::npos) return std::string(text);
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"') result += '"';
    result += c;
  }
  return result + '"';
}

}  // namespace loft::io
