// SPDX-License-Identifier: MIT
#pragma once

#include "overlay/polygon.h"

namespace loft::overlay {

[[nodiscard]] inline Ring box(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

[[nodiscard]] inline Ring square(double x, double y, double size) {
  return box(x, y, x + size, y + size);
}

}  // namespace loft::overlay
