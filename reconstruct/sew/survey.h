// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/adjacency.h"
#include "mesh/measure.h"
#include "reconstruct/sew/sewing.h"
#include "reconstruct/sew/surface_sink.h"

namespace loft {

/// Measures a surface while it is sewn, layer by layer: the same figures as measure().
class Survey {
 public:
  void add_vertices(std::span<const SurfaceVertex> vertices);
  /// A face, in the order of faces.
  void add_face(const std::array<Vec3, 3>& corners);
  /// How the faces of a final layer are connected, to one another and to those of the layer below,
  /// which was the last one. Beyond the layers from `first` up to `bound` the surface ends.
  void connect(const Sewing& sewing, std::uint32_t layer, std::uint32_t first = 0,
               std::uint32_t bound = Origin::none);

  [[nodiscard]] Measures measures();
  [[nodiscard]] const std::array<std::size_t, 4>& vertices_of_kind() const { return kinds_; }

 private:
  Measures measures_;
  FaceSum sum_;
  std::array<std::size_t, 4> kinds_{};
  std::size_t side_count_ = 0;
  std::size_t rim_side_count_ = 0;   // where the surface ends
  std::size_t rim_count_ = 0;        // closed chains of such sides
  std::vector<std::uint32_t> part_;  // of each face of the last layer, in parts_
  DisjointSets parts_{0};            // connected parts of layers
};

}  // namespace loft
