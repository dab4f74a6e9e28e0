// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cdt/triangulation.h"
#include "fields/separator.h"

namespace loft::fields {

/// Finds the vertices beside pieces of separators: the corners of the finite triangles that a piece
/// touches. Between two vertices that are joined by an edge and of which one is not beside, no
/// piece leads through: both are on the same side of everything.
class BesidePieces {
 public:
  /// Forgets what was found.
  void begin(const cdt::Triangulation& mesh);
  /// Adds those beside a piece that begins or ends at a vertex. False where all vertices are in one
  /// line: then there is no triangle. Cost: the triangles that it touches.
  [[nodiscard]] bool add(const SeparatorPiece& piece, cdt::VertexId end);

  /// Each once.
  [[nodiscard]] std::span<const cdt::VertexId> vertices() const { return vertices_; }
  /// Adds another one, unless it is there.
  bool add(cdt::VertexId v);

 private:
  [[nodiscard]] bool touches(const SeparatorPiece& piece, cdt::EdgeId e) const;
  void reach(cdt::TriangleId t);

  const cdt::Triangulation* mesh_ = nullptr;
  std::vector<std::uint32_t> triangle_round_;  // by triangle: the last piece that touched it
  std::vector<std::uint32_t> vertex_round_;    // by vertex: the last begin() after which it came
  std::uint32_t triangle_now_ = 0;
  std::uint32_t vertex_now_ = 0;
  std::vector<cdt::TriangleId> front_;
  std::vector<cdt::VertexId> vertices_;
};

}  // namespace loft::fields
