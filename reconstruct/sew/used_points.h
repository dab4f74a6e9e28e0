// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "reconstruct/clean/region.h"
#include "reconstruct/tile/tiles.h"

namespace loft {

/// A region without the points of lines that no tile has: they are on no surface. Regions without
/// lines have none such.
class UsedPoints {
 public:
  UsedPoints() = default;
  /// `below`, `above`: the tiles of the slabs there, null where there is none; `lower` is the
  /// region below the slab below.
  UsedPoints(const Region& region, const Region* lower, const TileSet* below, const TileSet* above);

  [[nodiscard]] bool has_lines() const { return region_.has_value(); }
  /// Precondition: it has lines.
  [[nodiscard]] const Region& region() const { return *region_; }
  /// The number of a point in region().
  [[nodiscard]] std::uint32_t number(std::uint32_t point) const {
    return region_ ? numbers_[point] : point;
  }

 private:
  std::optional<Region> region_;
  std::vector<std::uint32_t> numbers_;
};

/// Numbers the nodes of tiles between two regions by what is used of these.
void renumber(TileSet& tiles, const Region& lower, const Region& upper,
              const UsedPoints& used_lower, const UsedPoints& used_upper);

}  // namespace loft
