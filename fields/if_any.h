// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

namespace loft::fields {

/// A value, or none where it is not a number.
[[nodiscard]] inline std::optional<double> if_any(double value) {
  return value == value ? std::optional(value) : std::nullopt;
}

}  // namespace loft::fields
