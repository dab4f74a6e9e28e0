// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "cdt/triangulation.h"

namespace loft::io {

/// The vertices of a triangulation, by id, without the infinite one.
template <class Mesh>
[[nodiscard]] std::vector<cdt::VertexId> vertices_of(const Mesh& mesh) {
  std::vector<cdt::VertexId> ids;
  ids.reserve(mesh.vertex_count());
  if constexpr (requires { mesh.vertex_bound(); }) {
    for (std::uint32_t i = 1; i < mesh.vertex_bound(); ++i)
      if (mesh.is_vertex(cdt::VertexId(i))) ids.emplace_back(i);
  } else {
    for (std::uint32_t i = 1; i <= mesh.vertex_count(); ++i) ids.emplace_back(i);
  }
  return ids;
}

/// The triangles of a triangulation, by id, infinite ones included.
template <class Mesh>
[[nodiscard]] std::vector<cdt::TriangleId> triangles_of(const Mesh& mesh) {
  std::vector<cdt::TriangleId> ids;
  ids.reserve(mesh.triangle_count());
  if constexpr (requires { mesh.triangle_bound(); }) {
    for (std::uint32_t i = 0; i < mesh.triangle_bound(); ++i)
      if (mesh.is_triangle(cdt::TriangleId(i))) ids.emplace_back(i);
  } else {
    for (std::uint32_t i = 0; i < mesh.triangle_count(); ++i) ids.emplace_back(i);
  }
  return ids;
}

/// The constraints of a triangulation, by id.
template <class Mesh>
[[nodiscard]] std::vector<cdt::ConstraintId> constraints_of(const Mesh& mesh) {
  std::vector<cdt::ConstraintId> ids;
  ids.reserve(mesh.constraint_count());
  if constexpr (requires { mesh.constraint_bound(); }) {
    for (std::uint32_t i = 0; i < mesh.constraint_bound(); ++i)
      if (mesh.is_constraint(cdt::ConstraintId(i))) ids.emplace_back(i);
  } else {
    for (std::uint32_t i = 0; i < mesh.constraint_count(); ++i) ids.emplace_back(i);
  }
  return ids;
}

/// The edges along a constraint, in order and direction.
template <class Mesh>
[[nodiscard]] std::vector<cdt::EdgeId> pieces_of(const Mesh& mesh, cdt::ConstraintId constraint) {
  if constexpr (requires { mesh.pieces(constraint); }) {
    return mesh.pieces(constraint);
  } else {
    std::vector<cdt::EdgeId> edges;
    std::uint32_t segment = mesh.first_segment(constraint).index();
    for (std::size_t left = mesh.segments(constraint).size(); left > 0; --left, ++segment) {
      const std::vector<cdt::EdgeId> some = mesh.pieces(cdt::SegmentId(segment));
      edges.insert(edges.end(), some.begin(), some.end());
    }
    return edges;
  }
}

}  // namespace loft::io
