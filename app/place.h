// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace loft::app {

/// The lines with a place in front of each.
inline std::string with_place(const std::string& lines, const std::string& place) {
  std::string result = place;
  for (const char c : lines) {
    result += c;
    if (c == '\n') result += place;
  }
  return result;
}

}  // namespace loft::app
