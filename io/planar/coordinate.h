// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "mesh/admitted.h"
#include "reconstruct/usable.h"

namespace loft::io {

/// Whether a triangulation can take the number: it is finite, not too large and not too small.
[[nodiscard]] inline bool is_coordinate(double value) { return admitted::planar.admits(value); }

/// Why it cannot: `NaN is not a number`, `1e+80 is beyond 1e+75`, `1e-99 is nearer to 0 than 1e-50,
/// but not 0`.
[[nodiscard]] inline std::string why_no_coordinate(double value) {
  return why_not_admitted(value, admitted::planar);
}

}  // namespace loft::io
