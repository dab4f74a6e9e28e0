// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "mesh/mesh.h"

namespace loft::io {

/// Where and how long a format with `float` coordinates has things: about an origin, in a unit of
/// its own.
struct FloatFrame {
  Vec3 origin{};      ///< in the input's axes and unit
  double factor = 1;  ///< what a unit of the input is in the file

  /// A place as the file has it: rounded. -0 is 0.
  [[nodiscard]] Vec3 rounded(const Vec3& place) const {
    Vec3 result{};
    for (std::size_t axis = 0; axis < 3; ++axis)
      result[axis] =
          static_cast<double>(static_cast<float>((place[axis] - origin[axis]) * factor)) + 0.0;
    return result;
  }
};

}  // namespace loft::io
