// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>

#include "cdt/predicates.h"
#include "mesh/mesh.h"

namespace loft {

/// Exact geometric decisions in space, by the means and within the limits of cdt/predicates.h.

/// Which side of the plane through a, b, c the point d is on: +1 the side from which a, b, c run
/// counter-clockwise (where their face looks to), -1 the other, 0 exactly in the plane.
/// Laws: an even permutation of the four points keeps the sign, an odd one turns it; 0 if two of
/// the points are equal.
[[nodiscard]] int orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// Whether the three points are in one line: the triangle they make has no area.
[[nodiscard]] bool collinear(const Vec3& a, const Vec3& b, const Vec3& c);

/// The corners of a triangle.
using Corners = std::array<Vec3, 3>;

/// Of a face whose indices are in range.
[[nodiscard]] inline Corners corners(const Mesh& mesh, std::uint32_t face) {
  const auto [a, b, c] = mesh.faces[face];
  return {mesh.points[a], mesh.points[b], mesh.points[c]};
}

/// Whether two closed triangles have any point in common other than the corners at the same place
/// in both and the edge between two such corners. Two triangles with three common corners do meet.
/// Precondition: neither is degenerate.
/// Laws: triangles_meet(p, q) == triangles_meet(q, p), whatever the order of each one's corners.
[[nodiscard]] bool triangles_meet(const Corners& p, const Corners& q);

namespace detail {

/// Three differences, product, difference of products, product, two sums: 8 roundings
/// (see cdt/predicates.h for the argument).
inline constexpr double orient3d_bound = 9 * cdt::detail::rounding;

/// orient3d without filter.
[[nodiscard]] int orient3d_exact(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

/// orient3d as far as floating point tells: 0 where it does not.
[[nodiscard]] inline int orient3d_filter(const Vec3& a, const Vec3& b, const Vec3& c,
                                         const Vec3& d) {
  const double ax = a[0] - d[0], ay = a[1] - d[1], az = a[2] - d[2];
  const double bx = b[0] - d[0], by = b[1] - d[1], bz = b[2] - d[2];
  const double cx = c[0] - d[0], cy = c[1] - d[1], cz = c[2] - d[2];
  const double bc = bx * cy, cb = cx * by;
  const double ca = cx * ay, ac = ax * cy;
  const double ab = ax * by, ba = bx * ay;
  const double determinant = az * (cb - bc) + bz * (ac - ca) + cz * (ba - ab);
  const double magnitude = std::abs(az) * (std::abs(bc) + std::abs(cb)) +
                           std::abs(bz) * (std::abs(ca) + std::abs(ac)) +
                           std::abs(cz) * (std::abs(ab) + std::abs(ba));
  const double bound = orient3d_bound * magnitude;
  if (determinant > bound) return 1;
  if (determinant < -bound) return -1;
  return 0;
}

}  // namespace detail

inline int orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const int side = detail::orient3d_filter(a, b, c, d);
  return side != 0 ? side : detail::orient3d_exact(a, b, c, d);
}

}  // namespace loft
