// SPDX-License-Identifier: MIT
#include "reconstruct/linking.h"

#include <algorithm>
#include <utility>

namespace loft {

Linking::Linking(std::span<const Region> regions, const Options& options)
    : regions_(regions),
      options_(options),
      orders_(orders_of_slabs(regions, options.links, early_refusals_)),
      tiles_(orders_.size()),
      pieces_(orders_.size()),
      wanted_(orders_.size()),
      forbidden_(orders_.size()),
      links_(orders_.size()),
      refusals_(orders_.size()) {}

void Linking::tile(std::size_t slab) {
  OrderedTiles made = tile_by_orders(regions_[slab], regions_[slab + 1], options_, orders_[slab]);
  tiles_[slab] = std::move(made.tiles);
  pieces_[slab] = std::move(made.pieces);
  wanted_[slab] = std::move(made.wanted);
  forbidden_[slab] = std::move(made.forbidden);
  refusals_[slab] = std::move(made.refusals);
}

SlabPieces Linking::view(std::size_t slab) const {
  if (slab >= slab_count()) return {};
  return {&pieces_[slab], regions_[slab + 1].z - regions_[slab].z};
}

void Linking::match(std::size_t slab) {
  links_[slab] = wanted_[slab];
  if (options_.link != LinkRule::automatic) return;
  const SlabPieces below = slab == 0 ? SlabPieces() : view(slab - 1);
  for (const EndLink& link :
       match_ends(below, view(slab), view(slab + 1), options_.max_shift, forbidden_[slab])) {
    const bool is_free = std::ranges::none_of(wanted_[slab], [&](const EndLink& wanted) {
      return wanted.lower == link.lower || wanted.upper == link.upper;
    });
    if (is_free) links_[slab].push_back(link);
  }
}

namespace {

/// Whether a piece has one of some lower loops and one of some upper ones.
bool are_linked(const Pieces& pieces, const SlabOrder& order) {
  const auto has = [](const Footprint& footprint, const std::vector<std::uint32_t>& loops) {
    return std::ranges::any_of(loops, [&](std::uint32_t loop) {
      return std::ranges::find(footprint.loops, loop) != footprint.loops.end();
    });
  };
  return std::ranges::any_of(pieces.pieces, [&](const Piece& piece) {
    return has(piece.lower, order.lower) && has(piece.upper, order.upper);
  });
}

}  // namespace

void Linking::link(std::size_t slab) {
  link_ends(regions_[slab], regions_[slab + 1], tiles_[slab], pieces_[slab], links_[slab]);
  for (const SlabOrder& order : orders_[slab]) {
    const bool is_refused =
        std::ranges::find(refusals_[slab], order.order, &Refusal::order) != refusals_[slab].end();
    if (is_refused || are_linked(pieces_[slab], order) == order.is_link) continue;
    refusals_[slab].push_back({order.order, order.is_link
                                                ? "its tiles would meet others between the slices"
                                                : "both are linked with another part in common"});
  }
}

std::vector<Refusal> Linking::refusals() const {
  std::vector<Refusal> all = early_refusals_;
  for (const auto& of_slab : refusals_) all.insert(all.end(), of_slab.begin(), of_slab.end());
  std::ranges::stable_sort(all, {}, &Refusal::order);
  return all;
}

}  // namespace loft
