// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "bench/workload.h"
#include "cdt/point.h"
#include "cdt/triangulation.h"

namespace loft::bench {

/// A triangulation as anybody would write it down: places, triangles, constrained edges.
struct PlainMesh {
  using Index = std::uint32_t;
  std::vector<cdt::Point> vertices;
  std::vector<std::array<Index, 3>> triangles;
  std::vector<std::array<Index, 2>> constrained;
};

[[nodiscard]] PlainMesh plain(const cdt::Triangulation& mesh);

/// What a mesh is and what is wrong with it, found without the library's own check.
struct Verdict {
  std::size_t vertices = 0;
  std::size_t triangles = 0;
  std::size_t constrained_edges = 0;
  std::size_t bad_orientation = 0;      ///< triangles that are not counter-clockwise
  std::size_t non_delaunay = 0;         ///< free edges with a corner in the circle beyond
  std::size_t nonmanifold = 0;          ///< edges of three triangles or more
  std::size_t constrained_missing = 0;  ///< constrained edges that no triangle has
  std::size_t uncovered_segments = 0;   ///< input segments without a chain of constrained edges

  void print() const;
};

/// Decisions are exact, but for the last: a chain may leave its segment by 1e-12 of the extent,
/// since crossings are rounded.
[[nodiscard]] Verdict verify(const PlainMesh& mesh, const Workload& workload);

/// Whether two meshes are the same, by coordinates.
struct Sameness {
  bool vertices = false;
  bool triangles = false;
  bool constrained = false;
};
[[nodiscard]] Sameness compare(const PlainMesh& one, const PlainMesh& other);

}  // namespace loft::bench
