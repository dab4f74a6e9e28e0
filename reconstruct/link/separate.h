// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <span>

#include "reconstruct/link/pieces.h"

namespace loft {

/// Takes apart pieces in which several parts of one slice become several of the other, where these
/// fall into groups of both slices that overlap one another little in comparison: two branches side
/// by side, say, which move so far that one comes over where the other was. Each group is tiled by
/// itself, as it is or moved over each other, and takes part in the piece's place if nothing meets
/// (exact test). Says whether it has changed any. Cost: that of the CDT of such pieces and of their
/// groups.
bool separate(const Region& lower, const Region& upper, TileSet& tiles, Pieces& pieces,
              std::span<const double> before, std::optional<double> max_shift);

}  // namespace loft
