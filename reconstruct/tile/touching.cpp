// SPDX-License-Identifier: MIT
#include "reconstruct/tile/touching.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "mesh/box3.h"
#include "mesh/vec3.h"

namespace loft {

namespace {

double clamped_share(double part, double whole) {
  return whole > 0 ? std::clamp(part / whole, 0.0, 1.0) : 0;
}

/// Of two lines from end to end.
double squared_distance(const Vec3& p, const Vec3& q, const Vec3& u, const Vec3& v) {
  const Vec3 first = minus(q, p);
  const Vec3 second = minus(v, u);
  const Vec3 between = minus(p, u);
  const double a = dot(first, first);
  const double b = dot(first, second);
  const double c = dot(first, between);
  const double e = dot(second, second);
  const double f = dot(second, between);
  double s = clamped_share(b * f - c * e, a * e - b * b);
  double t = clamped_share(b * s + f, e);
  s = clamped_share(b * t - c, a);
  t = clamped_share(b * s + f, e);
  return squared_length(minus(along(p, s, first), along(u, t, second)));
}

bool corner_touches(const Vec3& corner, const Corners& triangle, double distance) {
  const Vec3 normal = cross(minus(triangle[1], triangle[0]), minus(triangle[2], triangle[0]));
  const Vec3 way = minus(corner, triangle[0]);
  const double size = length(normal);
  if (!(std::abs(dot(normal, way)) < distance * size)) return false;
  for (unsigned i = 0; i < 3; ++i) {
    const Vec3 side = minus(triangle[(i + 1) % 3], triangle[i]);
    if (dot(cross(side, minus(corner, triangle[i])), normal) < 0) return false;
  }
  return true;
}

bool is_corner(const Vec3& place, const Corners& triangle) {
  return std::ranges::find(triangle, place) != triangle.end();
}

}  // namespace

bool triangles_touch(const Corners& a, const Corners& b, double distance) {
  if (!boxes_are_near(box_around(a), box_around(b), distance)) return false;
  std::array<Box3, 3> boxes;
  for (unsigned j = 0; j < 3; ++j) boxes[j] = box_around(b[j], b[(j + 1) % 3]);
  for (unsigned i = 0; i < 3; ++i) {
    const std::array own{a[i], a[(i + 1) % 3]};
    const Box3 box = box_around(own[0], own[1]);
    for (unsigned j = 0; j < 3; ++j) {
      const std::array other{b[j], b[(j + 1) % 3]};
      const bool have_end_in_common =
          own[0] == other[0] || own[0] == other[1] || own[1] == other[0] || own[1] == other[1];
      if (!have_end_in_common && boxes_are_near(box, boxes[j], distance) &&
          squared_distance(own[0], own[1], other[0], other[1]) < distance * distance)
        return true;
    }
    if (!is_corner(a[i], b) && corner_touches(a[i], b, distance)) return true;
    if (!is_corner(b[i], a) && corner_touches(b[i], a, distance)) return true;
  }
  return false;
}

}  // namespace loft
