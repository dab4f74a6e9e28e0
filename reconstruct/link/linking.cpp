// SPDX-License-Identifier: MIT
#include "reconstruct/link/linking.h"

#include <algorithm>
#include <utility>

#include "reconstruct/link/lean.h"
#include "reconstruct/link/link_ends.h"

namespace loft {

void Linking::add(const Region& region) {
  regions_.push_back(&region);
  if (regions_.size() > 1) slabs_.emplace_back();
}

void Linking::drop_below(std::size_t slab) {
  for (; first_ < slab; ++first_) {
    regions_.pop_front();
    slabs_.pop_front();
  }
}

void Linking::tile(std::size_t slab, TileWorkspace& workspace) {
  OrderedTiles made =
      tile_by_orders(region(slab), region(slab + 1), options_, orders(slab), workspace);
  at(slab) = {std::move(made.tiles),
              std::move(made.pieces),
              std::move(made.wanted),
              std::move(made.forbidden),
              {},
              std::move(made.refusals)};
}

SlabPieces Linking::view(std::size_t slab) const {
  if (slab >= slab_bound()) return {};
  return {&at(slab).pieces, region(slab + 1).z - region(slab).z, &region(slab), &region(slab + 1)};
}

void Linking::match(std::size_t slab) {
  Slab& here = at(slab);
  here.ends.links = here.wanted;
  if (options_.link != LinkRule::automatic) return;
  const SlabPieces below = slab == 0 ? SlabPieces() : view(slab - 1);
  EndPlan found = match_ends(below, view(slab), view(slab + 1), options_.max_shift, here.forbidden);
  here.ends.leans = std::move(found.leans);
  for (const EndLink& link : found.links) {
    const bool is_free = std::ranges::none_of(here.wanted, [&](const EndLink& wanted) {
      return wanted.lower == link.lower || wanted.upper == link.upper;
    });
    if (is_free) here.ends.links.push_back(link);
  }
}

namespace {

/// Whether a piece has one of some loops, or a line.
bool has(const Footprint& footprint, const std::vector<std::uint32_t>& loops,
         const std::optional<std::uint32_t>& line) {
  if (line) return std::ranges::find(footprint.lines, *line) != footprint.lines.end();
  return std::ranges::any_of(loops, [&](std::uint32_t loop) {
    return std::ranges::find(footprint.loops, loop) != footprint.loops.end();
  });
}

/// Whether a piece has of either slice what an order names.
bool are_linked(const Pieces& pieces, const SlabOrder& order) {
  return std::ranges::any_of(pieces.pieces, [&](const Piece& piece) {
    return has(piece.lower, order.lower, order.lower_line) &&
           has(piece.upper, order.upper, order.upper_line);
  });
}

const char* reason(const SlabOrder& order) {
  if (order.has_line())
    return order.is_link ? "a part ends in a point or a line if it covers that and does not go on"
                         : "a part that covers it ends there; leave the point or line out";
  return order.is_link ? "its tiles would meet others between the slices"
                       : "both are linked with another part in common";
}

}  // namespace

void Linking::link(std::size_t slab) {
  Slab& here = at(slab);
  link_ends(region(slab), region(slab + 1), here.tiles, here.pieces, here.ends.links);
  lean_ends(region(slab), region(slab + 1), here.tiles, here.pieces, here.ends.leans);
  for (const SlabOrder& order : orders(slab)) {
    const bool is_refused =
        std::ranges::find(here.refusals, order.order, &Refusal::order) != here.refusals.end();
    if (is_refused || are_linked(here.pieces, order) == order.is_link) continue;
    here.refusals.push_back({order.order, reason(order)});
  }
}

}  // namespace loft
