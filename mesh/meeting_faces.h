// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "mesh/mesh.h"

namespace loft {

/// Two faces of a mesh, the one with the lower number first.
using FacePair = std::pair<std::uint32_t, std::uint32_t>;

/// Calls task(i) for each i below a count, in any order, at once if it likes.
using Runner =
    std::function<void(std::size_t count, const std::function<void(std::size_t i)>& task)>;

/// A runner: one after the other.
inline void run_in_turn(std::size_t count, const std::function<void(std::size_t i)>& task) {
  for (std::size_t i = 0; i < count; ++i) task(i);
}

/// The pairs among some faces for which triangles_meet() is true, in order; of `most` or more those
/// that were found first.
///
/// Faces around a vertex that are side by side as seen along an axis meet nowhere else, and need no
/// test in pairs. What is left is found by a tree of boxes over the faces along a space-filling
/// curve; where boxes tell too few apart, being around long thin faces, by TrianglePairs. Cost: O(n
/// log n) in practice, most of it in what `run` gets to do; the result does not depend on that.
/// Precondition: the faces' indices are in range and none is degenerate.
[[nodiscard]] std::vector<FacePair> meeting_faces(const Mesh& mesh,
                                                  std::span<const std::uint32_t> faces,
                                                  std::size_t most,
                                                  const Runner& run = run_in_turn);

namespace detail {

/// By vertex: whether the given faces around it are all around it and side by side, so that they
/// have nothing in common but their common edges and the vertex. Where it says no they may be.
[[nodiscard]] std::vector<char> find_tidy_vertices(const Mesh& mesh,
                                                   std::span<const std::uint32_t> faces);

}  // namespace detail

}  // namespace loft
