// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>

#include "reconstruct/shape/bent_tiles.h"
#include "reconstruct/shape/freedom.h"
#include "reconstruct/shape/outlines.h"
#include "reconstruct/tile/tiles.h"

namespace loft {

/// Tiles bent as bend() does it, and straightened again where they would meet one another or
/// `others`, tiles of the slab that stay as they are (exact test). None if even straight they
/// would: plain ones do not. Cost: O(n log n) for n tiles in the result, in practice, and O(log n)
/// for each of the others.
[[nodiscard]] std::optional<TileSet> bend_apart(const BentSlab& slab,
                                                std::span<const OutlinePoint> outlines,
                                                const TileSet& plain, const Fineness& fineness,
                                                const TileSet& others = {});

}  // namespace loft
