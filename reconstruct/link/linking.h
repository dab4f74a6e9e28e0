// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <deque>
#include <vector>

#include "reconstruct/link/link_orders.h"
#include "reconstruct/link/pieces.h"
#include "reconstruct/options.h"
#include "reconstruct/tile/tiles.h"

namespace loft {

/// Tiles and links the slabs of a stack, from the lowest upwards, each in three steps. A step of
/// one slab reads what the step before has made of it and of the slabs beside it, and writes its
/// own slab only; so each step can be done for many slabs at once. What a slab becomes is a
/// function of its two slices and one on either side; of its own two alone, if nothing ends in it
/// or nothing begins.
class Linking {
 public:
  /// Keeps a reference to the options. `orders` are those of each slab (orders_of_slabs()).
  explicit Linking(const Options& options, std::vector<std::vector<SlabOrder>> orders = {})
      : options_(options), orders_(std::move(orders)) {}

  /// The next region upwards; it must stay where it is until drop_below() passes its slabs.
  void add(const Region& region);
  /// Slab i is between the regions i and i + 1, in the order they were added.
  [[nodiscard]] std::size_t slab_bound() const {
    return regions_.empty() ? first_ : first_ + regions_.size() - 1;
  }

  void tile(std::size_t slab, TileWorkspace& workspace);  ///< by overlap and by orders
  void match(std::size_t slab);                           ///< finds which ends belong together
  void link(std::size_t slab);                            ///< joins them

  /// What the last step made.
  [[nodiscard]] TileSet& tiles(std::size_t slab) { return at(slab).tiles; }
  [[nodiscard]] Pieces& pieces(std::size_t slab) { return at(slab).pieces; }
  /// The orders to a slab that could not be met.
  [[nodiscard]] const std::vector<Refusal>& refusals(std::size_t slab) const {
    return at(slab).refusals;
  }

  /// Forgets the slabs below.
  void drop_below(std::size_t slab);

 private:
  struct Slab {
    TileSet tiles;
    Pieces pieces;
    std::vector<EndLink> wanted;
    std::vector<EndLink> forbidden;
    EndPlan ends;
    std::vector<Refusal> refusals;
  };

  [[nodiscard]] const Region& region(std::size_t i) const { return *regions_[i - first_]; }
  [[nodiscard]] Slab& at(std::size_t slab) { return slabs_[slab - first_]; }
  [[nodiscard]] const Slab& at(std::size_t slab) const { return slabs_[slab - first_]; }
  [[nodiscard]] std::span<const SlabOrder> orders(std::size_t slab) const {
    if (slab >= orders_.size()) return {};
    return orders_[slab];
  }
  [[nodiscard]] SlabPieces view(std::size_t slab) const;

  const Options& options_;
  std::vector<std::vector<SlabOrder>> orders_;
  std::deque<const Region*> regions_;
  std::deque<Slab> slabs_;
  std::size_t first_ = 0;  // slab and region at the front
};

}  // namespace loft
