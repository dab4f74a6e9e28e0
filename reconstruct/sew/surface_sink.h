// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "mesh/mesh.h"
#include "reconstruct/origin.h"

namespace loft {

struct SurfaceVertex {
  Vec3 place;
  Origin origin;
};

/// Counter-clockwise seen from outside. Corners are vertex numbers as in VertexNumbers.
struct SurfaceFace {
  std::array<std::uint32_t, 3> corners;
  FaceKind kind;
  std::uint32_t slab;
};

/// How vertices are numbered while it is not known yet how many there will be. First come the
/// plain ones: of slices and of the inside of slabs. Behind them come those that sewing adds where
/// parts touch: first the doubled ones, then midpoints of edges. Until the end these two are
/// counted for themselves and marked by the highest bits.
struct VertexNumbers {
  static constexpr std::uint32_t doubled_mark = 0x8000'0000;
  static constexpr std::uint32_t midpoint_mark = 0xc000'0000;
  static constexpr std::uint32_t bound = 0x4000'0000;  ///< of each count

  std::uint32_t plain = 0;
  std::uint32_t doubled = 0;

  /// The number in the finished surface.
  [[nodiscard]] std::uint32_t final(std::uint32_t number) const {
    if ((number & doubled_mark) == 0) return number;
    const bool is_midpoint = (number & midpoint_mark) == midpoint_mark;
    return plain + (is_midpoint ? doubled : 0) + (number & (bound - 1));
  }
};

/// Receives a surface piece by piece. Vertices come in the order of their numbers, faces in theirs;
/// faces may come before vertices that they name.
class SurfaceSink {
 public:
  virtual ~SurfaceSink() = default;
  virtual void add_vertices(std::span<const SurfaceVertex> vertices) = 0;
  virtual void add_faces(std::span<const SurfaceFace> faces) = 0;
  /// That was all.
  virtual void end(const VertexNumbers& numbers) = 0;
};

}  // namespace loft
