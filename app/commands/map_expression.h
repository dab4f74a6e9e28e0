// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "overlay/overlay.h"

namespace loft::app {

/// Reads what an option says over the layers of an overlay, by their names; where two have the
/// same, the first. Throws UsageError that says what is not understood, and what layers there are.
[[nodiscard]] overlay::Expression expression_over(const overlay::Overlay& overlay,
                                                  const std::string& text,
                                                  const std::string& option);

/// The names of an overlay's layers as expressions have them, `A, "two words", ...`, so many and no
/// more.
[[nodiscard]] std::string listed_layers(const overlay::Overlay& overlay);

/// Of an expression that is true where no layer is.
[[nodiscard]] inline std::string without_bounds(const std::string& option) {
  return option +
         ": the expression is true where no layer is, so without bounds; subtract from a frame "
         "instead";
}

}  // namespace loft::app
