// SPDX-License-Identifier: MIT
#include "reconstruct/shape/freedom.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace loft {

namespace {

using cdt::Point;

constexpr double degree = std::numbers::pi / 180;

/// An outline that turns by less is round, one that turns by more has a corner.
constexpr double round_turn = 20 * degree;
constexpr double corner_turn = 50 * degree;

/// A link goes on straight if it comes that near to a corner of the next slice, as a share of the
/// shortest edge at its ends and there; twice as far away it does not.
constexpr double straightness = 0.02;

/// A piece of whose edges at least that share is loose is as free as these.
constexpr double least_loose = 0.75;

/// A piece whose outlines turn by at least that share at round points is as free as these; one that
/// turns at corners alone is a polyhedron.
constexpr double least_round = 0.1;

/// The links of a slab, against the corners of the slices before and after it.
class Links {
 public:
  Links(const BentSlab& slab, std::span<const OutlinePoint> outlines)
      : slab_(slab), outlines_(outlines) {}

  /// 0 if the edge is a link that goes on straight below or above.
  [[nodiscard]] double looseness(std::uint32_t a, std::uint32_t b) const {
    const auto [low, high] = std::minmax(a, b);
    const auto lower_count = static_cast<std::uint32_t>(slab_.lower.points.size());
    if (low >= lower_count || high < lower_count || high >= outlines_.size()) return 1;
    const Point from = slab_.lower.points[low];
    const Point to = slab_.upper.points[high - lower_count];
    const double edge = std::min(outlines_[low].edge, outlines_[high].edge);
    if (edge == 0) return 1;  // a tip, which has none
    return std::min(looseness(slab_.slices[0], from, to, edge),
                    looseness(slab_.slices[3], from, to, edge));
  }

 private:
  [[nodiscard]] double looseness(const SliceShape* slice, Point from, Point to, double edge) const {
    if (slice == nullptr) return 1;
    const double share = (slice->z - slab_.lower.z) / (slab_.upper.z - slab_.lower.z);
    const Point there{from.x + share * (to.x - from.x), from.y + share * (to.y - from.y)};
    const auto corner = slice->distance.corner_near(there, 2 * straightness * edge);
    if (!corner) return 1;
    const double off = corner->distance / (straightness * std::min(edge, corner->edge));
    return std::clamp(off - 1, 0.0, 1.0);
  }

  const BentSlab& slab_;
  std::span<const OutlinePoint> outlines_;
};

/// An edge of the plain tiles.
struct PlainEdge {
  double link;        // its own looseness
  double beside = 0;  // that of the tightest other link of a tile at it; of the looser tile
};

}  // namespace

Freedom::Freedom(const BentSlab& slab, std::span<const OutlinePoint> outlines, const TileSet& tiles)
    : contour_count_(static_cast<std::uint32_t>(outlines.size())),
      plain_count_(contour_count_ + static_cast<std::uint32_t>(tiles.inner.size())),
      loose_(plain_count_, 1) {
  find_roundness(outlines, tiles);
  find_looseness(slab, outlines, tiles);
  weigh_pieces(slab, tiles);
  hold_polyhedra(slab, outlines);
}

/// An inner node is as round as the contour vertices are that it has tiles with.
void Freedom::find_roundness(std::span<const OutlinePoint> outlines, const TileSet& tiles) {
  for (const OutlinePoint& point : outlines)
    roundness_.push_back(
        std::clamp((corner_turn - point.turn) / (corner_turn - round_turn), 0.0, 1.0));
  std::vector<double> sums(tiles.inner.size());
  std::vector<double> counts(tiles.inner.size());
  for (const Tile& tile : tiles.tiles) {
    for (const std::uint32_t node : tile.nodes) {
      if (node < contour_count_) continue;
      for (const std::uint32_t other : tile.nodes) {
        if (other >= contour_count_) continue;
        sums[node - contour_count_] += roundness_[other];
        ++counts[node - contour_count_];
      }
    }
  }
  for (std::size_t i = 0; i < sums.size(); ++i)
    roundness_.push_back(counts[i] > 0 ? sums[i] / counts[i] : 1);
}

void Freedom::find_looseness(const BentSlab& slab, std::span<const OutlinePoint> outlines,
                             const TileSet& tiles) {
  const Links links(slab, outlines);
  std::vector<PlainEdge> edges;
  std::vector<std::array<std::uint32_t, 3>> of_tiles;
  for (const Tile& tile : tiles.tiles) {
    auto& of_tile = of_tiles.emplace_back();
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = tile.nodes[i];
      const std::uint32_t b = tile.nodes[(i + 1) % 3];
      const auto [edge, is_known] = edges_.at(a, b);
      if (!is_known) {
        edge = static_cast<std::uint32_t>(edges.size());
        edges.push_back({links.looseness(a, b)});
      }
      of_tile[i] = edge;
    }
  }
  for (const auto& of_tile : of_tiles) {
    for (std::size_t i = 0; i < 3; ++i) {
      PlainEdge& edge = edges[of_tile[i]];
      edge.beside = std::max(edge.beside, std::min(edges[of_tile[(i + 1) % 3]].link,
                                                   edges[of_tile[(i + 2) % 3]].link));
    }
  }
  for (const PlainEdge& edge : edges) edge_loose_.push_back(std::min(edge.link, edge.beside));
}

/// By the edges between contours of both slices; those upon contours tell nothing.
void Freedom::weigh_pieces(const BentSlab& slab, const TileSet& tiles) {
  const auto lower_count = slab.lower.points.size();
  std::vector<double> sums(slab.pieces.pieces.size());
  std::vector<double> counts(slab.pieces.pieces.size());
  for (std::size_t t = 0; t < tiles.tiles.size(); ++t) {
    const auto& nodes = tiles.tiles[t].nodes;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [low, high] = std::minmax(nodes[i], nodes[(i + 1) % 3]);
      if (high < contour_count_ && (low < lower_count) == (high < lower_count)) continue;
      sums[slab.pieces.of_tile[t]] += looseness(low, high);
      ++counts[slab.pieces.of_tile[t]];
    }
  }
  for (std::size_t i = 0; i < sums.size(); ++i)
    of_piece_.push_back(counts[i] > 0 ? std::min(sums[i] / counts[i] / least_loose, 1.0) : 1);
}

void Freedom::hold_polyhedra(const BentSlab& slab, std::span<const OutlinePoint> outlines) {
  for (std::size_t i = 0; i < of_piece_.size(); ++i) {
    double turns = 0;
    double round_turns = 0;
    const auto add = [&](const Region& region, const Footprint& footprint, std::size_t first) {
      for (const std::uint32_t loop : footprint.loops) {
        for (const std::uint32_t point : region.loop(loop)) {
          const double turn = outlines[first + point].turn;
          turns += turn;
          round_turns += turn * roundness_[first + point];
        }
      }
    };
    const Piece& piece = slab.pieces.pieces[i];
    add(slab.lower, piece.lower, 0);
    add(slab.upper, piece.upper, slab.lower.points.size());
    if (turns > 0) of_piece_[i] *= std::min(round_turns / turns / least_round, 1.0);
  }
}

/// What came from an edge is as loose as it is; what lies in a tile, as the middles that it joins.
double Freedom::looseness(std::uint32_t a, std::uint32_t b) const {
  const auto [low, high] = std::minmax(a, b);
  if (high < plain_count_) return edge_loose_[edges_.find(low, high)];
  return low < contour_count_ ? loose_[high] : (loose_[low] + loose_[high]) / 2;
}

}  // namespace loft
