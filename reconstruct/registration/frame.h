// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "mesh/mesh.h"
#include "reconstruct/clean/region.h"
#include "reconstruct/registration/displacement.h"
#include "reconstruct/tile/tiles.h"

namespace loft {

/// Two regions moved over each other, and the way back: what is at the share t of the slab's height
/// came there by 1 - t of the lower region's way and t of the upper one's.
class Frame {
 public:
  /// Keeps references to the regions. A way for each of their points.
  Frame(const Region& lower, const Region& upper, std::span<const cdt::Point> lower_ways,
        std::span<const cdt::Point> upper_ways);

  [[nodiscard]] const Region& lower() const { return lower_moved_; }
  [[nodiscard]] const Region& upper() const { return upper_moved_; }

  /// The area that tiles of the moved regions cover, seen from above: what is in one region only.
  [[nodiscard]] double covered(const TileSet& tiles) const;
  /// Puts the inner vertices of such tiles back. Contour vertices are where they always were.
  /// Where a sheet was narrow in the middle, as between branches that were drawn together, its
  /// Steiner vertices get the heights that the distances to the contours as they are suggest.
  /// An upright quad whose sides are one in the middle is a rectangle there, of which either
  /// diagonal will do; back in space it is askew, and gets the shorter one.
  void put_back(TileSet& tiles) const;

 private:
  [[nodiscard]] Vec3 put_back(const Vec3& place) const;
  void lift_anew(TileSet& tiles) const;
  void choose_diagonals(TileSet& tiles) const;
  [[nodiscard]] bool are_one(std::uint32_t lower_node, std::uint32_t upper_node,
                             double rounding) const;

  const Region& lower_;
  const Region& upper_;
  Region lower_moved_;
  Region upper_moved_;
  Interpolation lower_ways_;
  Interpolation upper_ways_;
};

}  // namespace loft
