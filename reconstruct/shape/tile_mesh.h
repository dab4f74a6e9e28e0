// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/predicates.h"
#include "mesh/triangle_tree.h"
#include "reconstruct/tile/tiles.h"

namespace loft {

/// The tiles of a slab, to be changed one by one: which are at a node or an edge, and whether
/// others could take their place. Nodes are numbered as in TileSet; new ones come last.
class TileMesh {
 public:
  using Nodes = std::array<std::uint32_t, 3>;
  /// From the end of the smaller place.
  struct Edge {
    double squared_length;
    std::uint32_t from;
    std::uint32_t to;
  };
  /// A tile at an edge, and its corner across from it.
  struct EdgeTile {
    std::uint32_t tile;
    std::uint32_t apex;
  };

  /// Keeps references to all three; changes the tiles. Cost: O(n).
  TileMesh(const Region& lower, const Region& upper, TileSet& tiles);

  [[nodiscard]] std::uint32_t node_count() const {
    return static_cast<std::uint32_t>(tiles_at_.size());
  }
  /// Whether a node was not there when the mesh was made.
  [[nodiscard]] bool is_added(std::uint32_t node) const { return node >= first_added_; }
  [[nodiscard]] Vec3 place(std::uint32_t node) const {
    return place_of(lower_, upper_, inner_, node);
  }
  [[nodiscard]] Corners places(const Nodes& nodes) const {
    return {place(nodes[0]), place(nodes[1]), place(nodes[2])};
  }
  [[nodiscard]] const Tile& tile(std::uint32_t tile) const { return tiles_[tile]; }
  [[nodiscard]] std::span<const Tile> tiles() const { return tiles_; }
  [[nodiscard]] std::span<const std::uint32_t> tiles_at(std::uint32_t node) const {
    return tiles_at_[node];
  }

  /// Whether both are contour vertices of one slice. Their edge is a contour edge, which belongs to
  /// the neighbouring slab as well; or one that rounding has left in the slice plane.
  [[nodiscard]] bool in_one_slice(std::uint32_t a, std::uint32_t b) const {
    return a < contour_count_ && b < contour_count_ && (a < lower_count_) == (b < lower_count_);
  }
  /// Whether a place is off both slice planes.
  [[nodiscard]] bool is_between_slices(const Vec3& place) const {
    return place[2] > lower_.z && place[2] < upper_.z;
  }

  [[nodiscard]] Edge edge(std::uint32_t a, std::uint32_t b) const;
  /// By length, those of the same length by place: a total order that numbers have no part in.
  [[nodiscard]] bool is_longer(const Edge& a, const Edge& b) const;
  /// The edges that are not in_one_slice(), each once.
  [[nodiscard]] std::vector<Edge> inner_edges() const;
  /// The tiles at an edge; none if it is not there.
  void find_tiles(const Edge& edge, std::vector<EdgeTile>& found) const;
  [[nodiscard]] bool are_joined(std::uint32_t a, std::uint32_t b) const;

  /// Whether triangles to come in the place of some tiles have an area, and touch each other and
  /// all other tiles in common corners and edges only (exact).
  [[nodiscard]] bool meet_nothing(std::span<const Nodes> triangles,
                                  std::span<const EdgeTile> replaced);

  std::uint32_t add_node(const Vec3& place);
  /// Takes back the last add_node(). Precondition: no tile has it.
  void remove_last_node();
  /// Moves an inner node. Its tiles are where they are for meet_nothing() after note_move().
  void move(std::uint32_t node, const Vec3& place);
  void note_move(std::uint32_t node);

  /// Adds a tile of the kind of one that it is near.
  void add(const Nodes& nodes, std::uint32_t near);
  void replace(std::uint32_t tile, const Nodes& nodes);
  /// The tile keeps its number until compact().
  void remove(std::uint32_t tile);
  /// Drops removed tiles and the added nodes that no tile has; renumbers both.
  void compact();

 private:
  void index_tiles();
  void build_tree();
  /// Tells the tree where a tile is now.
  void note(std::uint32_t tile);
  [[nodiscard]] bool is_removed(std::uint32_t tile) const {
    return tiles_[tile].nodes[0] == Origin::none;
  }

  std::vector<Tile>& tiles_;
  std::vector<InnerVertex>& inner_;
  const Region& lower_;
  const Region& upper_;
  std::uint32_t lower_count_;
  std::uint32_t contour_count_;
  std::uint32_t first_added_;
  std::vector<std::vector<std::uint32_t>> tiles_at_;  // each node
  TriangleTree tree_;
  std::size_t most_notes_ = 0;  // until the tree is made anew
  std::vector<Corners> corners_;
  std::vector<Vec3> hull_;
};

}  // namespace loft
