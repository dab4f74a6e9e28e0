// SPDX-License-Identifier: MIT
#pragma once

#include "cdt/point.h"

namespace loft::fields {

/// A direction with a length; a gradient.
struct Vector {
  double x = 0;
  double y = 0;

  friend bool operator==(const Vector&, const Vector&) = default;
  friend Vector operator+(Vector a, Vector b) { return {a.x + b.x, a.y + b.y}; }
  friend Vector operator*(double factor, Vector a) { return {factor * a.x, factor * a.y}; }
};

[[nodiscard]] inline double dot(Vector a, Vector b) { return a.x * b.x + a.y * b.y; }
[[nodiscard]] inline double cross(Vector a, Vector b) { return a.x * b.y - a.y * b.x; }

/// From one place to another.
[[nodiscard]] inline Vector way(cdt::Point from, cdt::Point to) {
  return {to.x - from.x, to.y - from.y};
}

/// The middle of a triangle.
[[nodiscard]] inline cdt::Point centroid(cdt::Point a, cdt::Point b, cdt::Point c) {
  return {a.x + (way(a, b).x + way(a, c).x) / 3, a.y + (way(a, b).y + way(a, c).y) / 3};
}

}  // namespace loft::fields
