// SPDX-License-Identifier: MIT
#include "reconstruct/shape/smooth.h"

#include <utility>

#include "reconstruct/shape/bent_tiles.h"
#include "reconstruct/shape/freedom.h"
#include "reconstruct/shape/outlines.h"
#include "reconstruct/shape/straighten.h"

namespace loft {

TileSet smooth(const Region& lower, const Region& upper, const Surroundings& slices,
               const Pieces& pieces, TileSet tiles, std::optional<double> tolerance) {
  if (!tiles.is_linked || tiles.tiles.empty()) return tiles;
  auto bent = bend_apart({lower, upper, slices, pieces}, outline_points(lower, upper), tiles,
                         fineness(upper.z - lower.z, tolerance));
  return bent ? std::move(*bent) : std::move(tiles);
}

}  // namespace loft
