// SPDX-License-Identifier: MIT
#pragma once

namespace loft {

/// Whether a measure, 0 or more, is within a bound. What is just at it is, whichever way rounding
/// went: many parts move by just half of their size, or grow to just twice their area, and how they
/// are linked must not depend on how the stack is turned.
[[nodiscard]] constexpr bool is_within(double measure, double bound) {
  constexpr double rounding = 1e-9;
  return measure <= bound + rounding * bound;
}

}  // namespace loft
