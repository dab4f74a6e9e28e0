// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <variant>
#include <vector>

#include "reconstruct/shape/freedom.h"
#include "reconstruct/shape/smooth_shape.h"

namespace loft {

/// The nearest place above or below that is not nearer to the slices at `bottom` and `top` than
/// vertices may be; or than the height `z` is, if that is nearer.
[[nodiscard]] Vec3 between_slices(double bottom, double top, const Vec3& place, double z);

/// Where the smooth surface of a slab is: that of each piece of its tiles.
class SmoothTarget {
 public:
  /// `nearness`: a place is on the surface if it is nearer than that share of the slab's height.
  /// Keeps a reference to the slab's regions and slices. Cost: O(n log n) for n tiles, in practice.
  SmoothTarget(const BentSlab& slab, const TileSet& tiles, double nearness);

  /// The way from a place to the surface of a piece, no further than `most`, where it faces as
  /// contours do; see SmoothPassage::at(). 0 if the slices do not tell where it is.
  [[nodiscard]] Vec3 way_from(const Vec3& place, std::uint32_t piece, double most,
                              cdt::Point facing) const;
  /// The same to the surface on which distances change evenly from slice to slice; 0 for an end.
  [[nodiscard]] Vec3 even_way_from(const Vec3& place, std::uint32_t piece, double most,
                                   cdt::Point facing) const;
  /// Whether a piece is bent to a spheroid that ends between the slices.
  [[nodiscard]] bool is_end(std::uint32_t piece) const {
    return std::holds_alternative<SmoothEnd>(shapes_[piece]);
  }

 private:
  /// What a connected piece of the tiles is bent to; nothing if its slices do not tell.
  using Shape = std::variant<std::monostate, SmoothPassage, SmoothEnd>;

  template <class SampleAt>
  [[nodiscard]] Vec3 way_from(const Vec3& place, double most, const SampleAt& sample_at) const;

  double bottom_;
  double height_;
  double nearness_;
  std::vector<Shape> shapes_;  // of each piece
};

}  // namespace loft
