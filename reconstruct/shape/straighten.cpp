// SPDX-License-Identifier: MIT
#include "reconstruct/shape/straighten.h"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "mesh/box_tree.h"
#include "mesh/predicates.h"
#include "mesh/triangle_pairs.h"
#include "mesh/vec3.h"
#include "reconstruct/link/replace.h"
#include "reconstruct/shape/smooth_target.h"
#include "reconstruct/shape/ways.h"

namespace loft {

namespace {

constexpr std::uint32_t none = Origin::none;

/// Where bent tiles meet they are straightened by half, and wholly below that share.
constexpr double least_bend = 0.2;
constexpr int most_corrections = 12;

/// Where straightened tiles still meet, flips have gone too far: it is done again without them
/// there; at last without any.
constexpr int most_attempts = 3;

/// Takes moves of bent tiles back until none meet.
class Straightening {
 public:
  Straightening(const Region& lower, const Region& upper, BentTiles& bent)
      : lower_(lower), upper_(upper), bent_(bent), contour_count_(contour_count(lower, upper)) {}

  /// Whether that is so.
  bool run() {
    for (int i = 0; i < most_corrections; ++i) {
      find_meeting();
      if (std::ranges::find(is_met_, true) == is_met_.end()) return true;
      if (!straighten()) return false;
    }
    return false;
  }

  /// The nodes of the plain tiles at those that still meet, and whose edges these came from, are
  /// set.
  void note_meeting(std::vector<bool>& nodes) const {
    std::vector<std::uint32_t> front = nodes_of_meeting();
    while (!front.empty()) {
      const std::uint32_t node = front.back();
      front.pop_back();
      if (node < nodes.size()) {
        nodes[node] = true;
      } else {
        for (const std::uint32_t end : bent_.moves[node - contour_count_].edge)
          if (end != none) front.push_back(end);
      }
    }
  }

 private:
  [[nodiscard]] const TileSet& tiles() const { return bent_.tiles; }

  [[nodiscard]] Vec3 place(std::uint32_t node) const {
    return place_of(lower_, upper_, tiles().inner, node);
  }

  [[nodiscard]] std::vector<std::uint32_t> nodes_of_meeting() const {
    std::vector<std::uint32_t> nodes;
    for (std::uint32_t t = 0; t < is_met_.size(); ++t)
      if (is_met_[t])
        nodes.insert(nodes.end(), tiles().tiles[t].nodes.begin(), tiles().tiles[t].nodes.end());
    return nodes;
  }

  /// Takes moves back by half where tiles meet. Returns whether any were left to take back.
  bool straighten() {
    std::vector<VertexMove>& moves = bent_.moves;
    std::vector<std::uint32_t> front = nodes_of_meeting();
    std::vector<bool> is_done(moves.size());
    while (!front.empty()) {
      const std::uint32_t node = front.back();
      front.pop_back();
      if (node == none || node < contour_count_ || is_done[node - contour_count_]) continue;
      is_done[node - contour_count_] = true;
      VertexMove& move = moves[node - contour_count_];
      move.share = move.share > least_bend ? move.share / 2 : 0;
      front.insert(front.end(), move.edge.begin(), move.edge.end());
    }
    return put_in_place();
  }

  /// Puts vertices where their moves lead. Returns whether any has moved.
  bool put_in_place() {
    std::vector<bool> is_moved(bent_.moves.size());
    for (std::uint32_t i = 0; i < is_moved.size(); ++i) {
      const Vec3 before = tiles().inner[i].place;
      VertexMove& move = bent_.moves[i];
      if (move.edge[0] != none)
        move.start = edge_middle(this->place(move.edge[0]), this->place(move.edge[1]));
      // Its edge has moved, too: not beyond a slice.
      const Vec3 after = between_slices(lower_.z, upper_.z, along(move.start, move.share, move.way),
                                        move.start[2]);
      bent_.tiles.inner[i].place = after;
      is_moved[i] = after != before;
    }
    find_doubtful(is_moved);
    return std::ranges::find(is_moved, true) != is_moved.end();
  }

  /// The tiles of which some may meet now: those that have changed, and those that met before.
  void find_doubtful(const std::vector<bool>& is_moved) {
    doubtful_.clear();
    for (std::uint32_t t = 0; t < is_met_.size(); ++t) {
      const auto& nodes = tiles().tiles[t].nodes;
      const bool has_changed = std::ranges::any_of(nodes, [&](std::uint32_t node) {
        return node >= contour_count_ && is_moved[node - contour_count_];
      });
      if (has_changed || is_met_[t]) doubtful_.push_back(t);
    }
  }

  [[nodiscard]] Corners corners(std::uint32_t tile) const {
    const auto& [a, b, c] = tiles().tiles[tile].nodes;
    return {place(a), place(b), place(c)};
  }

  /// The tiles that are degenerate or meet others elsewhere than in common corners and edges.
  void find_meeting() {
    if (!pairs_) {
      doubtful_.resize(tiles().tiles.size());
      std::iota(doubtful_.begin(), doubtful_.end(), 0U);
      corners_.resize(tiles().tiles.size());
      for (const Tile& tile : tiles().tiles) nodes_.push_back(tile.nodes);
    }
    is_met_.assign(tiles().tiles.size(), false);
    for (const std::uint32_t t : doubtful_) {
      const Corners& c = corners_[t] = corners(t);
      is_met_[t] = collinear(c[0], c[1], c[2]);
    }
    if (pairs_) {
      pairs_->update(doubtful_, corners_, nodes_);
    } else {
      pairs_.emplace(corners_, nodes_, contour_count_ + tiles().inner.size());
    }
    pairs_->for_each_changed([&](std::uint32_t i, std::uint32_t j) {
      if ((is_met_[i] && is_met_[j]) || !triangles_meet(corners_[i], corners_[j])) return;
      is_met_[i] = is_met_[j] = true;
    });
  }

  const Region& lower_;
  const Region& upper_;
  BentTiles& bent_;
  std::uint32_t contour_count_;
  std::vector<bool> is_met_;             // of each tile, when that was looked at last
  std::vector<std::uint32_t> doubtful_;  // the tiles of which that has to be found anew
  std::vector<Corners> corners_;         // of each tile, then
  std::vector<TrianglePairs::Vertices> nodes_;
  std::optional<TrianglePairs> pairs_;  // of those that may meet
};

/// Where tiles may be on the way from bent to straight.
class Reaches {
 public:
  Reaches(const BentSlab& slab, const BentTiles& bent) : slab_(slab), bent_(bent) {
    const std::uint32_t contours = contour_count(slab.lower, slab.upper);
    for (const VertexMove& move : bent.moves) {
      double before = 0;  // of the ends of its edge, which are there already
      for (const std::uint32_t end : move.edge)
        if (end != none && end >= contours) before = std::max(before, far_[end - contours]);
      far_.push_back(before + length(move.way));
    }
  }

  [[nodiscard]] BoxTree tree() const {
    std::vector<Box3> boxes;
    for (const Tile& tile : bent_.tiles.tiles)
      boxes.push_back(joined(joined(box(tile.nodes[0]), box(tile.nodes[1])), box(tile.nodes[2])));
    return BoxTree(boxes);
  }

 private:
  [[nodiscard]] Box3 box(std::uint32_t node) const {
    const std::uint32_t contours = contour_count(slab_.lower, slab_.upper);
    if (node < contours) {
      const Vec3 place = place_of(slab_.lower, slab_.upper, {}, node);
      return {place, place};
    }
    const Vec3& straight = bent_.moves[node - contours].straight;
    const double far = far_[node - contours];
    return {minus(straight, {far, far, far}), along(straight, far, {1, 1, 1})};
  }

  const BentSlab& slab_;
  const BentTiles& bent_;
  std::vector<double> far_;  // each inner vertex from where it would be if nothing were bent
};

/// Those of some tiles that bent ones may come near.
TileSet near_ones(const BentSlab& slab, const BentTiles& bent, const TileSet& tiles) {
  const BoxTree reaches = Reaches(slab, bent).tree();
  TileSet near;
  near.inner = tiles.inner;
  for (const Tile& tile : tiles.tiles) {
    const auto place = [&](std::size_t i) {
      return place_of(slab.lower, slab.upper, tiles.inner, tile.nodes[i]);
    };
    bool is_near = false;
    reaches.for_each_meeting(box_around(place(0), place(1), place(2)),
                             [&](std::uint32_t) { is_near = true; });
    if (is_near) near.tiles.push_back(tile);
  }
  drop_unused_inner(near.tiles, near.inner, contour_count(slab.lower, slab.upper));
  return near;
}

/// Adds tiles that do not move.
void add_fixed(BentTiles& bent, const TileSet& fixed, std::uint32_t contour_count) {
  append(bent.tiles, fixed, contour_count);
  for (const InnerVertex& vertex : fixed.inner)
    bent.moves.push_back({{none, none}, vertex.place, {}, vertex.place});
}

}  // namespace

std::optional<TileSet> bend_apart(const BentSlab& slab, std::span<const OutlinePoint> outlines,
                                  const TileSet& plain, const Fineness& fineness,
                                  const TileSet& others) {
  const std::size_t node_count = outlines.size() + plain.inner.size();
  std::vector<bool> firm;
  for (int attempt = 0; attempt < most_attempts; ++attempt) {
    if (attempt + 1 == most_attempts) firm.assign(node_count, true);
    BentTiles bent = bend(slab, outlines, plain, fineness, firm);
    const std::size_t tile_count = bent.tiles.tiles.size();
    const std::size_t inner_count = bent.tiles.inner.size();
    if (!others.tiles.empty())
      add_fixed(bent, near_ones(slab, bent, others), contour_count(slab.lower, slab.upper));
    Straightening straightening(slab.lower, slab.upper, bent);
    if (straightening.run()) {
      bent.tiles.tiles.resize(tile_count);
      bent.tiles.inner.resize(inner_count);
      return std::move(bent.tiles);
    }
    firm.resize(node_count);
    straightening.note_meeting(firm);
  }
  return {};
}

}  // namespace loft
