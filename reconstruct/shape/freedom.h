// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "reconstruct/clean/region.h"
#include "reconstruct/link/pieces.h"
#include "reconstruct/shape/edge_index.h"
#include "reconstruct/shape/outlines.h"
#include "reconstruct/shape/smooth_shape.h"
#include "reconstruct/tile/tiles.h"

namespace loft {

/// A slab that is to be bent: the regions its tiles lie between, and what is around them.
struct BentSlab {
  const Region& lower;
  const Region& upper;
  const Surroundings& slices;  ///< [1] and [2] are the shapes of `lower` and `upper`
  const Pieces& pieces;        ///< of the tiles
};

/// How freely the edges of a slab's tiles may bend, from 0 (straight) to 1, by what the slices
/// show:
///
/// - A link (an edge from slice to slice) that goes on straight to a corner of the slice before or
///   after the slab is an edge of the shape. It stays as it is.
/// - So does an edge with such links in the tiles on both its sides: it lies in a face.
/// - Where most edges of a piece are straight, the others are less free; not at all if all are.
/// - Distances to a slice do not change evenly beside a corner of its outline, even where every
///   face is flat: edges are the less free the sharper the outlines turn at their ends. A piece
///   whose outlines turn at corners alone, but for a tenth, is a polyhedron: less free as well.
///
/// In slices of a smooth shape vertices are anywhere: links hardly ever go on straight.
/// Knows the nodes of the plain tiles, and those that are added in the middles of edges.
class Freedom {
 public:
  /// `outlines`: at the points of both regions, one after the other. Cost: O(n log n) for n tiles,
  /// in practice.
  Freedom(const BentSlab& slab, std::span<const OutlinePoint> outlines, const TileSet& tiles);

  [[nodiscard]] double of_node(std::uint32_t node, std::uint32_t piece) const {
    return roundness_[node] * of_piece_[piece];
  }
  [[nodiscard]] double of_edge(std::uint32_t a, std::uint32_t b, std::uint32_t piece,
                               double looseness) const {
    return roundness(a, b) * looseness * of_piece_[piece];
  }
  /// 1 where outlines hardly turn at the ends of an edge, 0 where they have corners at both.
  [[nodiscard]] double roundness(std::uint32_t a, std::uint32_t b) const {
    return (roundness_[a] + roundness_[b]) / 2;
  }
  /// How little speaks for an edge to be straight. Precondition: the plain tiles have it, or one of
  /// its nodes was added.
  [[nodiscard]] double looseness(std::uint32_t a, std::uint32_t b) const;
  /// Gives the next number to a node in the middle of an edge.
  void add_middle(std::uint32_t a, std::uint32_t b, double looseness) {
    roundness_.push_back(roundness(a, b));
    loose_.push_back(looseness);
  }

 private:
  void find_roundness(std::span<const OutlinePoint> outlines, const TileSet& tiles);
  void find_looseness(const BentSlab& slab, std::span<const OutlinePoint> outlines,
                      const TileSet& tiles);
  void weigh_pieces(const BentSlab& slab, const TileSet& tiles);
  void hold_polyhedra(const BentSlab& slab, std::span<const OutlinePoint> outlines);

  std::uint32_t contour_count_;
  std::uint32_t plain_count_;
  std::vector<double> roundness_;  // of each node: 1 where outlines hardly turn
  std::vector<double> loose_;      // each node: looseness of the edge that it is the middle of
  EdgeIndex edges_;                // of the plain tiles: places in the next one
  std::vector<double> edge_loose_;
  std::vector<double> of_piece_;
};

}  // namespace loft
