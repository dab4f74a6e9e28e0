// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "reconstruct/origin.h"
#include "reconstruct/tile/tiles.h"

namespace loft {

/// The tiles of a slab by their half-edges, to split and flip edges one by one: half-edge 3t + i
/// goes from node i of tile t to the next one. Nodes are numbers; where they are is not known here.
class HalfEdges {
 public:
  static constexpr std::uint32_t none = Origin::none;

  /// Keeps the reference; changes the tiles. Cost: O(n).
  explicit HalfEdges(std::vector<Tile>& tiles);

  [[nodiscard]] std::uint32_t count() const { return static_cast<std::uint32_t>(twins_.size()); }
  [[nodiscard]] std::uint32_t from(std::uint32_t half) const { return node(half); }
  [[nodiscard]] std::uint32_t to(std::uint32_t half) const { return node(next(half)); }
  /// The corner of its tile that it does not have.
  [[nodiscard]] std::uint32_t apex(std::uint32_t half) const { return node(before(half)); }
  /// The same edge in the tile beside; none at a rim, and at an edge of more than two tiles.
  [[nodiscard]] std::uint32_t twin(std::uint32_t half) const { return twins_[half]; }

  /// Puts a node into an edge and joins it with both apexes. Returns the half-edges of all edges of
  /// the four tiles, those at the node last. The second and the third tile are new, the others keep
  /// their numbers. Precondition: there is a twin.
  std::array<std::uint32_t, 8> split(std::uint32_t half, std::uint32_t node);

  /// Puts the other diagonal of the two tiles in the place of an edge. Returns the half-edges of
  /// their edges, the diagonal last. Precondition: there is a twin, and no edge between the apexes.
  std::array<std::uint32_t, 5> flip(std::uint32_t half);

 private:
  [[nodiscard]] static std::uint32_t next(std::uint32_t half) {
    return half % 3 == 2 ? half - 2 : half + 1;
  }
  [[nodiscard]] static std::uint32_t before(std::uint32_t half) {
    return half % 3 == 0 ? half + 2 : half - 1;
  }
  [[nodiscard]] std::uint32_t node(std::uint32_t half) const {
    return tiles_[half / 3].nodes[half % 3];
  }
  void join(std::uint32_t half, std::uint32_t other);

  std::vector<Tile>& tiles_;
  std::vector<std::uint32_t> twins_;
};

}  // namespace loft
