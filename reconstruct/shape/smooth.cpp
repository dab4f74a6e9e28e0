// SPDX-License-Identifier: MIT
#include "reconstruct/shape/smooth.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "mesh/predicates.h"
#include "mesh/triangle_pairs.h"
#include "mesh/vec3.h"
#include "reconstruct/shape/bent_tiles.h"
#include "reconstruct/shape/freedom.h"
#include "reconstruct/shape/outlines.h"
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

/// At the points of both regions, one after the other.
std::vector<OutlinePoint> outlines_of(const Region& lower, const Region& upper) {
  std::vector<OutlinePoint> points = outline_points(lower);
  const std::vector<OutlinePoint> above = outline_points(upper);
  points.insert(points.end(), above.begin(), above.end());
  return points;
}

/// Takes moves of bent tiles back until none meet.
class Straightening {
 public:
  Straightening(const Region& lower, const Region& upper, BentTiles& bent)
      : lower_(lower),
        upper_(upper),
        bent_(bent),
        contour_count_(static_cast<std::uint32_t>(lower.points.size() + upper.points.size())) {}

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
        const auto& edge = bent_.moves[node - contour_count_].edge;
        front.insert(front.end(), edge.begin(), edge.end());
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

}  // namespace

TileSet smooth(const Region& lower, const Region& upper, const Surroundings& slices,
               const Pieces& pieces, TileSet tiles, std::optional<double> tolerance) {
  if (!tiles.is_linked || tiles.tiles.empty()) return tiles;
  const BentSlab slab{lower, upper, slices, pieces};
  const std::vector<OutlinePoint> outlines = outlines_of(lower, upper);
  const Fineness fine = fineness(upper.z - lower.z, tolerance);
  const std::size_t node_count = outlines.size() + tiles.inner.size();
  std::vector<bool> firm;
  for (int attempt = 0; attempt < most_attempts; ++attempt) {
    if (attempt + 1 == most_attempts) firm.assign(node_count, true);
    BentTiles bent = bend(slab, outlines, tiles, fine, firm);
    Straightening straightening(lower, upper, bent);
    if (straightening.run()) return std::move(bent.tiles);
    firm.resize(node_count);
    straightening.note_meeting(firm);
  }
  return tiles;
}

}  // namespace loft
