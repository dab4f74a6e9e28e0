// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "reconstruct/clean/region.h"
#include "reconstruct/tile/tiles.h"

namespace loft {

/// Some loops, and lines, of a region as a region of their own. Where they bound a cavity, turned
/// round: its inside becomes the region's.
class Extract {
 public:
  Extract(const Region& region, std::span<const std::uint32_t> loops, bool is_solid,
          std::span<const std::uint32_t> lines = {});

  [[nodiscard]] const Region& region() const { return extract_; }
  /// The index in the whole region of a point of the extract.
  [[nodiscard]] std::uint32_t original(std::uint32_t point) const { return original_[point]; }

 private:
  Region extract_;
  std::vector<std::uint32_t> original_;
};

/// Tiles of a part of a slab as tiles of the slab: nodes renumbered, those of a cavity turned to
/// look the other way. Inner vertices keep their order, from the first number on.
[[nodiscard]] TileSet embedded(TileSet tiles, const Extract& lower, const Extract& upper,
                               std::uint32_t lower_count, std::uint32_t upper_count, bool is_solid);

}  // namespace loft
