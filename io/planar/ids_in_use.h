// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "cdt/triangulation.h"

namespace loft::io {

/// The ids from `first` up to a bound that name something.
template <class Id, class IsThere>
[[nodiscard]] std::vector<Id> ids_below(std::size_t bound, IsThere is_there,
                                        std::uint32_t first = 0) {
  std::vector<Id> ids;
  for (std::uint32_t i = first; i < bound; ++i)
    if (is_there(Id(i))) ids.emplace_back(i);
  return ids;
}

/// The vertices of a triangulation, by id, without the infinite one.
[[nodiscard]] inline std::vector<cdt::VertexId> vertices_of(const cdt::Triangulation& mesh) {
  return ids_below<cdt::VertexId>(
      mesh.vertex_bound(), [&](cdt::VertexId v) { return mesh.is_vertex(v); }, 1);
}

/// The triangles of a triangulation, by id, infinite ones included.
[[nodiscard]] inline std::vector<cdt::TriangleId> triangles_of(const cdt::Triangulation& mesh) {
  return ids_below<cdt::TriangleId>(mesh.triangle_bound(),
                                    [&](cdt::TriangleId t) { return mesh.is_triangle(t); });
}

/// The constraints of a triangulation, by id.
[[nodiscard]] inline std::vector<cdt::ConstraintId> constraints_of(const cdt::Triangulation& mesh) {
  return ids_below<cdt::ConstraintId>(mesh.constraint_bound(),
                                      [&](cdt::ConstraintId c) { return mesh.is_constraint(c); });
}

}  // namespace loft::io
