// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace loft {

/// A place in space; z is across the slices.
using Vec3 = std::array<double, 3>;

/// Triangles over a list of places, nothing promised: what a mesh file holds.
/// Faces are counter-clockwise seen from outside.
struct Mesh {
  std::vector<Vec3> points;
  std::vector<std::array<std::uint32_t, 3>> faces;

  friend bool operator==(const Mesh&, const Mesh&) = default;
};

}  // namespace loft
