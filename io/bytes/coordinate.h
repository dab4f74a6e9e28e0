// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <string>

#include "cdt/triangulation.h"
#include "reconstruct/number_text.h"

namespace loft::io {

/// Whether a triangulation can take the number: it is finite, not too large and not too small.
[[nodiscard]] inline bool is_coordinate(double value) {
  return cdt::Triangulation::is_usable(value);
}

/// Why it cannot: `NaN is not a number`, `1e+80 is larger than 1e+75`, `1e-99 is below 1e-50, but
/// not 0`.
[[nodiscard]] inline std::string why_no_coordinate(double value) {
  if (std::isnan(value)) return "NaN is not a number";
  std::string text;
  append_number(text, value);
  if (std::abs(value) < 1) {
    text += " is below ";
    append_number(text, cdt::Triangulation::smallest_coordinate);
    return text + ", but not 0";
  }
  text += " is larger than ";
  append_number(text, cdt::Triangulation::largest_coordinate);
  return text;
}

}  // namespace loft::io
