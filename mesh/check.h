// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "mesh/mesh.h"

namespace loft {

/// What can be wrong with a mesh that should bound a solid.
enum class Fault {
  bad_index,           ///< a face names a vertex that is not there
  not_finite,          ///< a coordinate is NaN or infinite
  out_of_range,        ///< a coordinate that exact tests cannot hold (mesh/admitted.h)
  degenerate_face,     ///< a face without area (exact)
  boundary_edge,       ///< an edge with one face: the surface is open
  nonmanifold_edge,    ///< an edge with more than two faces
  nonmanifold_vertex,  ///< a vertex whose faces form more than one fan
  inconsistent_edge,   ///< two faces that run along their edge in the same direction
  inside_out,  ///< a component that faces inwards where it should face outwards, or the reverse
  self_intersection,  ///< two faces that meet elsewhere than in common corners and edges (exact)
};

/// The fault's name as reports print it, for example `boundary_edge`.
[[nodiscard]] const char* name(Fault fault);

/// One fault and where it is: the faces and vertices that show it.
struct Finding {
  Fault fault;
  std::vector<std::uint32_t> faces;
  std::vector<std::uint32_t> vertices;
};

/// All faults of a mesh; empty if it bounds a solid: closed, manifold, oriented, outward, no
/// degenerate face, no self-intersection. Decisions are exact. Vertices at the same place count as
/// one for self-intersections (parts may touch where they share corners), not for topology.
/// inside_out is asked only of components that are closed, oriented and meet no other one, with a
/// volume beyond rounding. Faces without area, and those with a coordinate that is not finite or
/// out of range, are left out of self-intersections; those that name a vertex twice, of topology as
/// well. Findings come in the order of Fault, then of the elements.
/// Of self-intersections at most most_intersections(mesh) are found, so that memory is bounded by
/// the size of the mesh; where there are that many there may be more, and inside_out is not asked.
/// Cost: O(n log n) in practice.
[[nodiscard]] std::vector<Finding> check(const Mesh& mesh);

/// How many self-intersections check() looks for: what n faces have may be n * n / 2 of them.
[[nodiscard]] std::size_t most_intersections(const Mesh& mesh);

/// Where a surface touches itself in corners and edges that its parts have each for themselves:
/// as a solid may that was made from contours with corner contacts. No fault.
struct Contacts {
  std::size_t points = 0;  ///< places with more than one vertex, that of edges included
  std::size_t edges = 0;   ///< places with more than one edge
  Vec3 first{};            ///< the first of the points by its coordinates, if there is one

  friend bool operator==(const Contacts&, const Contacts&) = default;
};

/// Cost: O(n log n).
[[nodiscard]] Contacts contacts(const Mesh& mesh);

}  // namespace loft
