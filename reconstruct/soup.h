// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "reconstruct/mesh.h"
#include "reconstruct/origin.h"

namespace loft {

/// The faces of a surface before it is sewn: one vertex a slice and place, so that parts which only
/// touch share vertices and edges.
struct Soup {
  struct Face {
    std::array<std::uint32_t, 3> corners;
    FaceKind kind;
    std::uint32_t slab;
  };

  std::vector<Vec3> points;
  std::vector<Origin> origins;  // of each point
  std::vector<Face> faces;
  std::vector<std::uint32_t> slab_slices;  // the input's slice below each slab
};

/// Half-edge i of face f is `3 * f + i`, from corner i to the next. For each the one that the
/// surface continues with on the other side, or `no_mate` where it ends.
using Mates = std::vector<std::uint32_t>;
inline constexpr std::uint32_t no_mate = 0xffff'ffff;

/// Takes apart what only touches (design, section 3, step 8): at an edge with more than two faces
/// each is joined to its neighbour across the solid, vertices are doubled until each has one fan of
/// faces, and edges that still join the same two vertices get midpoints of their own.
/// Returns the mates. Precondition: a closed, oriented boundary of a solid, or the open rim of one.
/// Cost: O(n).
[[nodiscard]] Mates separate_touching(Soup& soup);

}  // namespace loft
