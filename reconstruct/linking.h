// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "reconstruct/link_orders.h"
#include "reconstruct/options.h"
#include "reconstruct/pieces.h"

namespace loft {

/// Tiles and links the slabs of a stack, each in three steps. A step of one slab reads what the
/// step before has made of it and of the slabs beside it, and writes its own slab only; so each
/// step can be done for all slabs at once. What a slab becomes is a function of its two slices and
/// one on either side; of its own two alone, if nothing ends in it or nothing begins.
class Linking {
 public:
  /// Keeps references to both. Slab i is between regions i and i + 1.
  Linking(std::span<const Region> regions, const Options& options);

  [[nodiscard]] std::size_t slab_count() const { return tiles_.size(); }

  void tile(std::size_t slab);   ///< by overlap and by orders
  void match(std::size_t slab);  ///< finds which ends belong together
  void link(std::size_t slab);   ///< joins them

  /// After the last step.
  [[nodiscard]] const std::vector<TileSet>& tiles() const { return tiles_; }
  [[nodiscard]] const std::vector<Pieces>& pieces() const { return pieces_; }
  /// The orders that could not be met, in the order of options.links, each once.
  [[nodiscard]] std::vector<Refusal> refusals() const;

 private:
  [[nodiscard]] SlabPieces view(std::size_t slab) const;

  std::span<const Region> regions_;
  const Options& options_;
  std::vector<Refusal> early_refusals_;         // of contours that are gone
  std::vector<std::vector<SlabOrder>> orders_;  // of each slab
  std::vector<TileSet> tiles_;
  std::vector<Pieces> pieces_;
  std::vector<std::vector<EndLink>> wanted_;
  std::vector<std::vector<EndLink>> forbidden_;
  std::vector<std::vector<EndLink>> links_;
  std::vector<std::vector<Refusal>> refusals_;
};

}  // namespace loft
