// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "mesh/vec3.h"
#include "reconstruct/surface.h"

namespace loft::triangles {

/// The triangles by the places of their corners, in an order of their own.
inline std::vector<std::array<Vec3, 3>> by_place(const Surface& surface) {
  const Mesh mesh = to_mesh(surface);
  std::vector<std::array<Vec3, 3>> result;
  for (const auto& [a, b, c] : mesh.faces) {
    result.push_back({mesh.points[a], mesh.points[b], mesh.points[c]});
    auto& corners = result.back();
    std::rotate(corners.begin(), std::ranges::min_element(corners), corners.end());
  }
  std::ranges::sort(result);
  return result;
}

inline double distance(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 along = minus(b, a);
  const double t = std::clamp(dot(minus(p, a), along) / squared_length(along), 0.0, 1.0);
  return std::sqrt(
      squared_length(minus(p, {a[0] + t * along[0], a[1] + t * along[1], a[2] + t * along[2]})));
}

/// To the plane, if the foot is on the inner side of all edges; else to the nearest edge.
inline double distance(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 normal = cross(minus(b, a), minus(c, a));
  const auto is_inside = [&](const Vec3& from, const Vec3& to) {
    return dot(cross(normal, minus(to, from)), minus(p, from)) >= 0;
  };
  if (is_inside(a, b) && is_inside(b, c) && is_inside(c, a))
    return std::abs(dot(normal, minus(p, a))) / std::sqrt(squared_length(normal));
  return std::min({distance(p, a, b), distance(p, b, c), distance(p, c, a)});
}

/// The largest distance of points all over one mesh to another one, by trying everything.
inline double farthest(const Mesh& from, const Mesh& to) {
  constexpr int steps = 4;
  double most = 0;
  for (const auto& [i, j, k] : from.faces)
    for (int s = 0; s <= steps; ++s)
      for (int t = 0; s + t <= steps; ++t) {
        Vec3 p{};
        for (unsigned axis = 0; axis < 3; ++axis)
          p[axis] = (s * from.points[i][axis] + t * from.points[j][axis] +
                     (steps - s - t) * from.points[k][axis]) /
                    steps;
        double least = std::numeric_limits<double>::infinity();
        for (const auto& [a, b, c] : to.faces)
          least = std::min(least, distance(p, to.points[a], to.points[b], to.points[c]));
        most = std::max(most, least);
      }
  return most;
}

}  // namespace loft::triangles
