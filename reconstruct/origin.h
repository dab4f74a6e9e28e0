// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace loft {

/// How a vertex of the surface came about.
enum class VertexKind : std::uint8_t {
  contour,   ///< a point of an input contour, unchanged but for Options::fair
  cleaning,  ///< made in a slice by cleaning: where contours of that slice cross
  crossing,  ///< where contour edges of two neighbouring slices cross in projection
  steiner,   ///< added between two slices: in forks and ends, and where the surface bends
};

/// Where a vertex of the surface comes from. Indices are those of the input.
struct Origin {
  static constexpr std::uint32_t none = 0xffff'ffff;

  VertexKind kind = VertexKind::steiner;
  std::uint32_t slice = none;    ///< contour, cleaning: its slice; otherwise the slice below it
  std::uint32_t contour = none;  ///< contour only
  std::uint32_t point = none;    ///< contour only

  friend bool operator==(const Origin&, const Origin&) = default;
};

/// Whether two origins are the same in their slices, whichever these are.
[[nodiscard]] inline bool is_same_in_slice(const Origin& a, const Origin& b) {
  return a.kind == b.kind && a.contour == b.contour && a.point == b.point;
}

/// What part of the surface a face belongs to.
enum class FaceKind : std::uint8_t {
  sheet,       ///< between two slices, over a part that is inside one of them only
  wall,        ///< between two slices, upright on a contour edge
  bottom_cap,  ///< closes the lowest slice
  top_cap,     ///< closes the highest slice
};

}  // namespace loft
