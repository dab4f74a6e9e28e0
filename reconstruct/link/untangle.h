// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "reconstruct/link/pieces.h"

namespace loft {

/// Moves pieces as their outlines match (move_registered()), where overlay alone has torn them:
/// each outline goes on as one, but the tiles have windows or handles, and the slices overlap
/// little. A function of the two slices.
void untangle(const Region& lower, const Region& upper, TileSet& tiles, Pieces& pieces,
              std::optional<double> max_shift);

}  // namespace loft
