// SPDX-License-Identifier: MIT
#include "reconstruct/shape/prism.h"

#include <algorithm>
#include <cmath>

#include "mesh/vec3.h"

namespace loft {

namespace {

/// 0 of what has no direction: then nothing is beyond.
Vec3 unit(const Vec3& a) {
  const double size = length(a);
  if (!(size > 0) || !std::isfinite(size)) return {};
  return {a[0] / size, a[1] / size, a[2] / size};
}

}  // namespace

Prism::Prism(const Corners& triangle, double distance)
    : box_(box_around(triangle[0], triangle[1], triangle[2])),
      distance_(distance),
      start_(triangle[0]) {
  const Vec3 normal = unit(cross(minus(triangle[1], triangle[0]), minus(triangle[2], triangle[0])));
  for (std::size_t i = 0; i < 3; ++i)
    sides_[i].way = unit(cross(minus(triangle[(i + 1) % 3], triangle[i]), normal));
  sides_[3].way = normal;
  sides_[4].way = {-normal[0], -normal[1], -normal[2]};
  // Where rounding has turned a direction there may be more of the triangle along it.
  for (Side& side : sides_) {
    for (const Vec3& p : triangle) side.most = std::max(side.most, dot(side.way, minus(p, start_)));
    side.most += distance;
  }
}

bool Prism::may_meet(const Corners& other) const {
  const auto& [a, b, c] = other;
  if (!boxes_are_near(box_, box_around(a, b, c), distance_)) return false;
  const Corners ways{minus(a, start_), minus(b, start_), minus(c, start_)};
  return std::ranges::none_of(sides_, [&](const Side& side) {
    return std::ranges::all_of(ways,
                               [&](const Vec3& way) { return dot(side.way, way) > side.most; });
  });
}

}  // namespace loft
