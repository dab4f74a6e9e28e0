// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <span>

#include "mesh/mesh.h"
#include "reconstruct/clean/region.h"
#include "reconstruct/registration/displacement.h"
#include "reconstruct/tile/tiles.h"

namespace loft {

/// Two regions moved over each other, and the way back: what is at a share t of the slab's height
/// belongs where (1 - t) of the lower region's way and t of the upper one's lead from.
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
  void put_back(TileSet& tiles);
  /// Splits edges of tiles that were put back, where the middle belongs farther than `most` from the
  /// middle between its ends, as on a face that turns.
  void split_askew(TileSet& tiles, double most);

 private:
  struct Askew;

  [[nodiscard]] Vec3 put_back(const Vec3& place) const;
  [[nodiscard]] Vec3 in_frame(const TileSet& tiles, std::uint32_t node) const;
  [[nodiscard]] bool is_contour(std::uint32_t node) const;
  [[nodiscard]] bool in_one_slice(std::uint32_t a, std::uint32_t b) const;
  [[nodiscard]] std::vector<Askew> find_askew(const TileSet& tiles, double most) const;

  const Region& lower_;
  const Region& upper_;
  Region lower_moved_;
  Region upper_moved_;
  Interpolation lower_ways_;
  Interpolation upper_ways_;
  std::map<Vec3, Vec3> frame_places_;  // of inner vertices, by where they are in space
};

}  // namespace loft
