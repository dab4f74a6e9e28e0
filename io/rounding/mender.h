// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <unordered_map>
#include <vector>

#include "io/rounding/float_frame.h"
#include "io/rounding/place_counts.h"
#include "mesh/predicates.h"
#include "mesh/triangle_tree.h"
#include "reconstruct/surface.h"

namespace loft::io {

/// Brings a surface into such places that it has fewer faults once they are rounded.
///
/// A vertex at a fault goes where there are the fewest faults around it, of the 26 ways to
/// neighbouring floats, in the plane of its slice first, then of 2, 4 and 8 units in the last
/// place, from where it was at first; no step makes more of them. Where none helps any more, an
/// edge of no more than that is collapsed.
class Mender {
 public:
  /// `mesh`: the surface at its rounded places. `counts` are kept up to date. All must outlive the
  /// mender.
  Mender(Surface& surface, const Mesh& mesh, const FloatFrame& frame, PlaceCounts& counts);

  /// Mends around these vertices as long as that helps. Where edges are collapsed elements are
  /// deleted: call garbage_collection() on the surface when all has been asked. Cost: a few
  /// microseconds a vertex and way tried, times its faces.
  void mend(std::span<const std::uint32_t> vertices);

  /// How many vertices.
  [[nodiscard]] std::size_t moved() const { return homes_.size(); }
  [[nodiscard]] std::size_t collapsed() const { return collapsed_; }
  /// The surface as it is after mend(), but all vertices where they were.
  [[nodiscard]] Mesh unmoved() const;

 private:
  using VertexHandle = Surface::VertexHandle;
  using FaceHandle = Surface::FaceHandle;
  using HalfedgeHandle = Surface::HalfedgeHandle;

  static constexpr std::size_t all = std::numeric_limits<std::size_t>::max();

  /// A face around a vertex, as it is or would be.
  struct StarFace {
    std::uint32_t face;
    Corners places;
    bool is_flat;
  };

  bool move(VertexHandle v);
  bool collapse(VertexHandle v);
  void put(VertexHandle v, const Surface::Point& point);
  void collapse(HalfedgeHandle h);
  void refresh(FaceHandle f);

  [[nodiscard]] const Vec3& place(VertexHandle v) const {
    return places_[static_cast<std::size_t>(v.idx())];
  }
  [[nodiscard]] Vec3 rounded(const Surface::Point& point) const {
    return frame_.rounded({point[0], point[1], point[2]});
  }
  [[nodiscard]] bool is_mendable(VertexHandle v) const;
  [[nodiscard]] bool is_near(VertexHandle v, VertexHandle other) const;
  [[nodiscard]] bool has(FaceHandle f, VertexHandle v) const;
  /// In the input's unit, along each axis: of the largest coordinates around the vertex.
  [[nodiscard]] Vec3 unit_around(VertexHandle v) const;

  /// How many faults there are around a vertex if it is at a place; not counted beyond `enough`.
  [[nodiscard]] std::size_t faults_at(VertexHandle v, const Vec3& at, std::size_t enough);
  /// Around both, once the first is gone into the other.
  [[nodiscard]] std::size_t faults_without(VertexHandle v, VertexHandle to, std::size_t enough);
  void add_to_star(FaceHandle f, VertexHandle moved, const Vec3& to);
  [[nodiscard]] std::size_t faults_of_star(std::size_t enough);
  [[nodiscard]] std::size_t others_that_meet(const StarFace& face) const;

  Surface& surface_;
  const FloatFrame& frame_;
  PlaceCounts& counts_;
  std::vector<Vec3> places_;    // of the vertices, rounded
  std::vector<bool> is_flat_;   // faces
  std::vector<bool> is_apart_;  // faces that are not asked of at present
  std::vector<StarFace> star_;
  TriangleTree tree_;
  std::unordered_map<int, Surface::Point> homes_;  // of vertices that were moved: where they were
  std::size_t collapsed_ = 0;
  std::size_t tries_ = 0;
};

}  // namespace loft::io
