// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "reconstruct/link/pieces.h"
#include "reconstruct/live/live_stack.h"
#include "reconstruct/shape/smooth.h"
#include "reconstruct/tile/tiles.h"

namespace loft {

/// A slab that is to be: between two slices that follow each other in the surface.
struct Gap {
  Station* lower;
  Station* upper;
  bool is_first;  ///< of the surface
  bool is_last;
  LiveSlab* there = nullptr;          ///< where it is there already
  std::optional<LiveSlab> made{};     ///< where it is not, or changes
  LiveSlab* before = nullptr;         ///< of which it keeps some tiles
  std::vector<std::uint32_t> kept{};  ///< which, as Retiled
  std::vector<std::uint32_t> dropped{};
  std::optional<TileSet> tiles{};  ///< before ends are linked, and after
  std::optional<Pieces> pieces{};
  bool keeps_tiles = false;  ///< only its caps change

  /// As it is to be.
  [[nodiscard]] LiveSlab& slab() { return made ? *made : *there; }
  [[nodiscard]] const LiveSlab& slab() const { return made ? *made : *there; }
  [[nodiscard]] double height() const { return upper->region->z - lower->region->z; }
};

/// The slabs near an edit, from low to high, as they are to be. They are made while the stack still
/// has those before; what is made is taken over by exchange().
class Gaps {
 public:
  /// `line`: the slices near the edit, from low to high; `is_bottom`, `is_top`: whether the surface
  /// ends with its first and its last one.
  Gaps(LiveStack& stack, std::vector<Station*> line, bool is_bottom, bool is_top);

  /// Makes those that are new or change, and gives them their ids.
  void make();

  [[nodiscard]] std::span<Gap> all() { return gaps_; }
  /// Where slabs begin that are there and are not among them.
  [[nodiscard]] const std::vector<double>& gone() const { return gone_; }
  /// The loops that a slice of that height had before, for slices of which slabs keep some tiles;
  /// null for others.
  [[nodiscard]] const std::vector<std::uint32_t>* matches(double z) const;

 private:
  using Shapes = std::array<std::shared_ptr<const SliceShape>, 4>;

  void find_present(bool is_bottom, bool is_top);
  void tile(Gap& gap);
  bool tile_in_part(Gap& gap);
  const std::vector<std::uint32_t>& match(const Station& station, const Region& old);
  void tile_by_overlap(Gap& gap);
  [[nodiscard]] bool has_neighbours(std::size_t i) const;
  [[nodiscard]] SlabPieces view(std::size_t i) const;
  void link(std::size_t i);
  [[nodiscard]] Shapes shapes_around(std::size_t i);
  void bend(std::size_t i);
  static void keep_unbent(Gap& gap, std::size_t tile_count, std::vector<bool> bent);
  void freeze(Gap& gap);

  LiveStack& stack_;
  std::vector<Station*> line_;
  std::vector<Gap> gaps_;  // between them
  std::vector<double> gone_;
  std::map<double, std::vector<std::uint32_t>> matches_;
};

}  // namespace loft
