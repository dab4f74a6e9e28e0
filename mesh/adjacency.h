// SPDX-License-Identifier: MIT
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/mesh.h"

namespace loft {

/// One face's side of an edge.
struct EdgeSide {
  std::uint32_t low = 0;   ///< the edge's end of the smaller index
  std::uint32_t high = 0;  ///< its other end
  std::uint32_t face = 0;
  std::uint32_t corner = 0;  ///< the face runs along the edge from this corner to the next

  friend auto operator<=>(const EdgeSide&, const EdgeSide&) = default;
};

/// Whether the face runs along the edge from low to high.
[[nodiscard]] bool runs_up(const Mesh& mesh, const EdgeSide& side);

/// The edges of a mesh, each with its faces, in the order of their ends.
class Edges {
 public:
  /// The edges of the given faces. Cost: O(n log n).
  Edges(const Mesh& mesh, std::span<const std::uint32_t> faces);

  [[nodiscard]] std::size_t size() const { return first_.size() - 1; }
  /// The sides of one edge, by face.
  [[nodiscard]] std::span<const EdgeSide> operator[](std::size_t edge) const;

 private:
  std::vector<EdgeSide> sides_;
  std::vector<std::uint32_t> first_;  ///< of each edge's sides, and one more
};

/// Disjoint sets of 0 .. n-1 (union by smaller index, with path halving).
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t n);
  /// The smallest element of the set that `element` is in.
  [[nodiscard]] std::uint32_t find(std::uint32_t element);
  void unite(std::uint32_t a, std::uint32_t b);
  /// A new element, n, in a set of its own.
  std::uint32_t add();
  /// How many sets there are. Cost: O(n).
  [[nodiscard]] std::size_t count() const;

 private:
  std::vector<std::uint32_t> parent_;
};

/// Faces that name three different vertices that are there, in order.
[[nodiscard]] std::vector<std::uint32_t> proper_faces(const Mesh& mesh);

/// For each face the first face of its component: the faces connected through edges.
[[nodiscard]] std::vector<std::uint32_t> components(const Mesh& mesh, const Edges& edges);

}  // namespace loft
