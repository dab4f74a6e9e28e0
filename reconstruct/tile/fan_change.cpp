// SPDX-License-Identifier: MIT
#include "reconstruct/tile/fan_change.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "mesh/vec3.h"
#include "reconstruct/plane/nearest.h"

namespace loft {

namespace {

using cdt::Point;

constexpr double infinity = std::numeric_limits<double>::infinity();

double distance(const Vec3& a, const Vec3& b) { return std::hypot(b[0] - a[0], b[1] - a[1]); }

/// Where an edge passes a height.
Point at_height(const Vec3& a, const Vec3& b, double z) {
  const double share = b[2] == a[2] ? 0 : (z - a[2]) / (b[2] - a[2]);
  return {a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])};
}

double shape(const Corners& t, double stretch) {
  Vec3 u = minus(t[1], t[0]);
  Vec3 v = minus(t[2], t[0]);
  Vec3 w = minus(t[2], t[1]);
  for (Vec3* side : {&u, &v, &w}) (*side)[2] *= stretch;
  const double sides = dot(u, u) + dot(v, v) + dot(w, w);
  return (dot(u, u) * dot(v, v) - dot(u, v) * dot(u, v)) / (sides * sides);
}

}  // namespace

void SheetsAround::add(const Corners& triangle) {
  const auto& [a, b, c] = triangle;
  const double twice = std::abs((b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1]));
  const double longest = std::max({distance(a, b), distance(b, c), distance(c, a)});
  area += twice / 2;
  if (longest > 0) width = std::max(width, twice / longest);
}

double reach(const Vec3& point, std::span<const Corners> triangles) {
  double farthest = 0;
  for (const Corners& triangle : triangles)
    for (const Vec3& corner : triangle) farthest = std::max(farthest, distance(point, corner));
  return farthest;
}

double gained_area(const Vec3& crossing, std::span<const Corners> fan, double height) {
  // From the same end, whichever way round the fan goes, so that sums are rounded in one way.
  const bool is_backwards = !fan.empty() && fan.back()[2] < fan.front()[1];
  double six_times = 0;
  for (std::size_t i = 0; i < fan.size(); ++i) {
    const Corners& t = fan[is_backwards ? fan.size() - 1 - i : i];
    six_times += dot(minus(t[0], crossing), cross(minus(t[1], crossing), minus(t[2], crossing)));
  }
  return six_times / 6 / height;
}

double sideways_drift(const Vec3& crossing, std::span<const Corners> fan) {
  const double z = crossing[2];
  double least = infinity;
  for (const Corners& t : fan) {
    std::array<Point, 3> ends;
    std::size_t count = 0;
    for (unsigned i = 0; i < 3; ++i) {
      const auto [a, b] = std::minmax(t[i], t[(i + 1) % 3]);
      if (std::min(a[2], b[2]) <= z && z <= std::max(a[2], b[2]))
        ends[count++] = at_height(a, b, z);
    }
    std::sort(ends.begin(), ends.begin() + count);
    for (std::size_t i = 0; i < count; ++i)
      least = std::min(least, distance({crossing[0], crossing[1]}, ends[0], ends[i]));
  }
  return least;
}

double worst_shape(std::span<const Corners> fan, double stretch) {
  double worst = infinity;
  for (const Corners& t : fan) worst = std::min(worst, shape(t, stretch));
  return worst;
}

}  // namespace loft
