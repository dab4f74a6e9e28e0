// SPDX-License-Identifier: MIT
#pragma once

#include <utility>

#include "cdt/point.h"

namespace loft {

/// The middle of an edge, the same to the last bit from either end.
[[nodiscard]] inline cdt::Point middle(cdt::Point a, cdt::Point b) {
  if (b < a) std::swap(a, b);
  return {a.x + (b.x - a.x) / 2, a.y + (b.y - a.y) / 2};
}

/// The middle of a triangle, the same to the last bit from every corner.
[[nodiscard]] inline cdt::Point middle(cdt::Point a, cdt::Point b, cdt::Point c) {
  if (b < a) std::swap(a, b);
  if (c < a) std::swap(a, c);
  if (c < b) std::swap(b, c);
  return {a.x + ((b.x - a.x) + (c.x - a.x)) / 3, a.y + ((b.y - a.y) + (c.y - a.y)) / 3};
}

}  // namespace loft
