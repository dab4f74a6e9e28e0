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

  /// The two tiles at an edge: its ends, and the corners left and right of it. Precondition: there
  /// is a twin.
  struct Diamond {
    std::uint32_t a;
    std::uint32_t b;
    std::uint32_t left;
    std::uint32_t right;

    friend bool operator==(const Diamond&, const Diamond&) = default;
  };
  [[nodiscard]] Diamond diamond(std::uint32_t half) const {
    return {from(half), to(half), apex(half), apex(twin(half))};
  }

  /// The other half-edges of its tile.
  [[nodiscard]] std::array<std::uint32_t, 2> others(std::uint32_t half) const {
    return {next(half), before(half)};
  }

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
  /// What lies beyond the sides of a diamond.
  struct Beyond {
    std::uint32_t b_left;
    std::uint32_t left_a;
    std::uint32_t a_right;
    std::uint32_t right_b;
  };
  [[nodiscard]] Beyond beyond(std::uint32_t half) const {
    const std::uint32_t other = twin(half);
    return {twin(next(half)), twin(before(half)), twin(next(other)), twin(before(other))};
  }
  void join(std::uint32_t half, std::uint32_t other);

  std::vector<Tile>& tiles_;
  std::vector<std::uint32_t> twins_;
};

}  // namespace loft
