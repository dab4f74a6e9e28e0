// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "mesh/mesh.h"

namespace loft {

/// Arithmetic on places and on the ways between them.
[[nodiscard]] inline Vec3 minus(const Vec3& a, const Vec3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

/// The place that is `share` of a way from p.
[[nodiscard]] inline Vec3 along(const Vec3& p, double share, const Vec3& way) {
  return {p[0] + share * way[0], p[1] + share * way[1], p[2] + share * way[2]};
}

[[nodiscard]] inline double dot(const Vec3& a, const Vec3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

[[nodiscard]] inline Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

[[nodiscard]] inline double squared_length(const Vec3& a) { return dot(a, a); }

[[nodiscard]] inline double length(const Vec3& a) { return std::sqrt(squared_length(a)); }

/// Scales it to length 1; false, and nothing is done, where its length is 0 or not finite.
inline bool make_unit(Vec3& v) {
  const double size = length(v);
  if (!(size > 0) || !std::isfinite(size)) return false;
  for (double& x : v) x /= size;
  return true;
}

}  // namespace loft
