// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <string>

#include "cdt/triangulation.h"
#include "io/text.h"

namespace loft::io {

/// Whether a triangulation can take the number: it is finite and not too large.
[[nodiscard]] inline bool is_coordinate(double value) {
  return std::abs(value) <= cdt::Triangulation::largest_coordinate;
}

/// Why it cannot: `NaN is not a number`, `1e+80 is larger than 1e+75`.
[[nodiscard]] inline std::string why_no_coordinate(double value) {
  if (std::isnan(value)) return "NaN is not a number";
  std::string text;
  append_number(text, value);
  text += " is larger than ";
  append_number(text, cdt::Triangulation::largest_coordinate);
  return text;
}

}  // namespace loft::io
