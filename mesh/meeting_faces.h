// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "mesh/mesh.h"

namespace loft {

/// Two faces of a mesh, the one with the lower number first.
using FacePair = std::pair<std::uint32_t, std::uint32_t>;

/// The pairs among some faces for which triangles_meet() is true, in order; of `most` or more those
/// that were found first.
///
/// Faces around a vertex that are side by side as seen along an axis meet nowhere else, and need no
/// test in pairs. What is left is found by a tree of boxes over the faces along a space-filling
/// curve; where boxes tell too few apart, being around long thin faces, by TrianglePairs. Cost: O(n
/// log n) in practice. Precondition: the faces' indices are in range and none is degenerate.
[[nodiscard]] std::vector<FacePair> meeting_faces(const Mesh& mesh,
                                                  std::span<const std::uint32_t> faces,
                                                  std::size_t most);

namespace detail {

/// By vertex: whether the given faces around it are all around it and side by side, so that they
/// have nothing in common but their common edges and the vertex. Where it says no they may be.
[[nodiscard]] std::vector<char> find_tidy_vertices(const Mesh& mesh,
                                                   std::span<const std::uint32_t> faces);

}  // namespace detail

}  // namespace loft
