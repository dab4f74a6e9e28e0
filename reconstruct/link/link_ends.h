// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "reconstruct/link/ends.h"

namespace loft {

/// Tiles matched ends as one piece each, the upper part moved over the lower one. If they then
/// cover less than 0.4 of what they cover together, and one is hollow, as where a shell closes, its
/// outlines are joined and its holes by themselves, or the holes end. If that makes too little of
/// an overlap, too, they are moved as their outlines match (move_by_loops()); else the match is
/// left out, unless an order asks for it. Ends that are branches of something are moved with it as
/// their places match, from over it (move_by_places()); those that lie beside it also by their ways
/// alone (move_by_ways()), or by shorter ones. What they are joined to may have been moved without
/// them, to where they belong; if the joint piece is no better than that, it is held against what
/// there was before. Else these are left out, and what else is linked is tried without them. Where
/// these tiles meet nothing else (exact test), they take the place of what they join; else that
/// stays as it was.
void link_ends(const Region& lower, const Region& upper, TileSet& tiles, Pieces& pieces,
               std::span<const EndLink> links);

}  // namespace loft
