// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <utility>

#include "mesh/mesh.h"

namespace loft::shapes {

/// A cube with faces outwards, from `low` to low + size along each axis.
inline Mesh cube(Vec3 low, double size) {
  Mesh mesh;
  for (unsigned i = 0; i < 8; ++i) {
    mesh.points.push_back(
        {low[0] + size * (i & 1U), low[1] + size * (i >> 1U & 1U), low[2] + size * (i >> 2U & 1U)});
  }
  mesh.faces = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

/// A tetrahedron with faces outwards, if d is on the side that a, b, c face to.
inline Mesh tetrahedron(Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
  return {{a, b, c, d}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}}};
}

/// A torus about the z axis, with n by m vertices.
inline Mesh torus(double ring_radius, double tube_radius, std::uint32_t n, std::uint32_t m) {
  Mesh mesh;
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = 0; j < m; ++j) {
      const double around = 2 * std::numbers::pi * i / n;
      const double tube = 2 * std::numbers::pi * j / m;
      const double radius = ring_radius + tube_radius * std::cos(tube);
      mesh.points.push_back(
          {radius * std::cos(around), radius * std::sin(around), tube_radius * std::sin(tube)});
    }
  }
  const auto vertex = [=](std::uint32_t i, std::uint32_t j) { return i % n * m + j % m; };
  for (std::uint32_t i = 0; i < n; ++i) {
    for (std::uint32_t j = 0; j < m; ++j) {
      mesh.faces.push_back({vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1)});
      mesh.faces.push_back({vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
    }
  }
  return mesh;
}

/// Both meshes side by side in one, no vertex in common.
inline Mesh operator+(Mesh a, const Mesh& b) {
  const auto offset = static_cast<std::uint32_t>(a.points.size());
  a.points.insert(a.points.end(), b.points.begin(), b.points.end());
  for (const auto& [i, j, k] : b.faces) a.faces.push_back({i + offset, j + offset, k + offset});
  return a;
}

/// The same mesh, faces looking to the other side.
inline Mesh flipped(Mesh mesh) {
  for (auto& face : mesh.faces) std::swap(face[1], face[2]);
  return mesh;
}

inline Mesh moved(Mesh mesh, Vec3 way) {
  for (Vec3& p : mesh.points) {
    for (std::size_t axis = 0; axis < 3; ++axis) p[axis] += way[axis];
  }
  return mesh;
}

}  // namespace loft::shapes
