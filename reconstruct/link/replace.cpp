// SPDX-License-Identifier: MIT
#include "reconstruct/link/replace.h"

#include <algorithm>
#include <compare>
#include <numeric>
#include <utility>

#include "mesh/box_tree.h"
#include "mesh/predicates.h"

namespace loft {

namespace {

Corners corners(const Region& lower, const Region& upper, const TileSet& tiles, const Tile& tile) {
  const auto place = [&](std::uint32_t node) { return place_of(lower, upper, tiles.inner, node); };
  return {place(tile.nodes[0]), place(tile.nodes[1]), place(tile.nodes[2])};
}

}  // namespace

void append(TileSet& tiles, const TileSet& more, std::uint32_t contour_count) {
  const auto inner_count = static_cast<std::uint32_t>(tiles.inner.size());
  tiles.inner.insert(tiles.inner.end(), more.inner.begin(), more.inner.end());
  tiles.reaches.insert(tiles.reaches.end(), more.reaches.begin(), more.reaches.end());
  for (Tile tile : more.tiles) {
    for (std::uint32_t& node : tile.nodes)
      if (node >= contour_count) node += inner_count;
    tiles.tiles.push_back(tile);
  }
}

namespace {

/// Decides which replacements hold, and puts them in.
class Replacing {
 public:
  Replacing(const Region& lower, const Region& upper, TileSet& tiles, Pieces& pieces,
            std::span<Replacement> replacements)
      : lower_(lower),
        upper_(upper),
        tiles_(tiles),
        pieces_(pieces),
        replacements_(replacements),
        contour_count_(contour_count(lower, upper)),
        is_kept_(replacements.size(), true),
        by_(pieces.pieces.size(), Origin::none) {}

  bool run() {
    find_meetings();
    while (drop_one_that_meets()) {
    }
    if (std::ranges::find(is_kept_, true) == is_kept_.end()) return false;
    put_in();
    return true;
  }

 private:
  /// A replacement meets a piece, or another replacement behind it.
  struct Meeting {
    std::uint32_t replacement;
    std::uint32_t other;
    bool is_piece;

    friend auto operator<=>(const Meeting&, const Meeting&) = default;
  };

  [[nodiscard]] bool is_replaced(std::uint32_t replacement, std::uint32_t piece) const {
    const auto& replaced = replacements_[replacement].replaced;
    return std::ranges::find(replaced, piece) != replaced.end();
  }

  /// The tiles of a replacement, to be found by their places.
  struct Placed {
    std::vector<Corners> corners;
    Box3 box;
    BoxTree tree;

    [[nodiscard]] bool meets(const Corners& tile) const {
      bool is_found = false;
      tree.for_each_meeting(box_around(tile), [&](std::uint32_t i) {
        is_found = is_found || triangles_meet(tile, corners[i]);
      });
      return is_found;
    }
  };

  [[nodiscard]] Placed placed(const TileSet& tiles) const {
    std::vector<Corners> places;
    std::vector<Box3> boxes;
    for (const Tile& tile : tiles.tiles) {
      places.push_back(corners(lower_, upper_, tiles, tile));
      boxes.push_back(box_around(places.back()));
    }
    const Box3 whole = std::accumulate(boxes.begin(), boxes.end(), boxes.front(), joined);
    return {std::move(places), whole, BoxTree(boxes)};
  }

  /// Tiles of one replacement, and those that it replaces, may be many and near each other: boxes
  /// around whole replacements keep them from being compared.
  void find_meetings() {
    std::vector<Placed> placed;
    std::vector<Box3> boxes;
    for (const Replacement& replacement : replacements_) {
      placed.push_back(this->placed(replacement.tiles));
      boxes.push_back(placed.back().box);
    }
    const BoxTree tree(boxes);
    tree.for_each_pair([&](std::uint32_t i, std::uint32_t j) {
      const auto meets = [&](const Corners& tile) { return placed[i].meets(tile); };
      if (std::ranges::any_of(placed[j].corners, meets))
        meetings_.push_back({std::min(i, j), std::max(i, j), false});
    });
    for (std::size_t t = 0; t < tiles_.tiles.size(); ++t) {
      const Corners here = corners(lower_, upper_, tiles_, tiles_.tiles[t]);
      const std::uint32_t piece = pieces_.of_tile[t];
      tree.for_each_meeting(box_around(here), [&](std::uint32_t r) {
        if (!is_replaced(r, piece) && placed[r].meets(here)) meetings_.push_back({r, piece, true});
      });
    }
    std::ranges::sort(meetings_);
    meetings_.erase(std::unique(meetings_.begin(), meetings_.end()), meetings_.end());
  }

  /// Of two that want the same piece, and of two that meet, the second goes; of one that meets a
  /// piece that stays, that one. Pieces of those dropped stay, after all.
  bool drop_one_that_meets() {
    std::ranges::fill(by_, Origin::none);
    for (std::uint32_t r = 0; r < replacements_.size(); ++r) {
      if (!is_kept_[r]) continue;
      for (const std::uint32_t piece : replacements_[r].replaced) {
        if (by_[piece] != Origin::none) {
          is_kept_[r] = false;
          return true;
        }
        by_[piece] = r;
      }
    }
    for (const Meeting& meeting : meetings_) {
      if (!is_kept_[meeting.replacement]) continue;
      if (meeting.is_piece ? by_[meeting.other] != Origin::none : !is_kept_[meeting.other])
        continue;
      is_kept_[meeting.is_piece ? meeting.replacement : meeting.other] = false;
      return true;
    }
    return false;
  }

  void put_in() {
    std::vector<Tile> kept;
    std::vector<std::uint32_t> of_kept;
    for (std::size_t t = 0; t < tiles_.tiles.size(); ++t) {
      if (by_[pieces_.of_tile[t]] != Origin::none) continue;
      kept.push_back(tiles_.tiles[t]);
      of_kept.push_back(pieces_.of_tile[t]);
    }
    tiles_.tiles = std::move(kept);
    tiles_.is_plain = false;
    pieces_.of_tile = std::move(of_kept);
    drop_unused_inner(tiles_.tiles, tiles_.inner, contour_count_);
    for (std::uint32_t r = 0; r < replacements_.size(); ++r) {
      if (!is_kept_[r]) continue;
      const Replacement& replacement = replacements_[r];
      append(tiles_, replacement.tiles, contour_count_);
      const auto count = static_cast<std::uint32_t>(pieces_.pieces.size());
      for (const std::uint32_t piece : replacement.pieces.of_tile)
        pieces_.of_tile.push_back(count + piece);
      for (const Piece& piece : replacement.pieces.pieces) pieces_.pieces.push_back(piece);
    }
    drop_replaced_pieces();
  }

  void drop_replaced_pieces() {
    by_.resize(pieces_.pieces.size(), Origin::none);
    std::vector<Piece> left;
    std::vector<std::uint32_t> place(by_.size(), Origin::none);
    for (std::uint32_t i = 0; i < by_.size(); ++i) {
      if (by_[i] != Origin::none) continue;
      place[i] = static_cast<std::uint32_t>(left.size());
      left.push_back(std::move(pieces_.pieces[i]));
    }
    pieces_.pieces = std::move(left);
    for (std::uint32_t& piece : pieces_.of_tile) piece = place[piece];
    sort_pieces(lower_, upper_, pieces_);
  }

  const Region& lower_;
  const Region& upper_;
  TileSet& tiles_;
  Pieces& pieces_;
  std::span<Replacement> replacements_;
  std::uint32_t contour_count_;
  std::vector<Meeting> meetings_;
  std::vector<bool> is_kept_;
  std::vector<std::uint32_t> by_;  // the replacement that each piece gives way to, or none
};

}  // namespace

bool replace(const Region& lower, const Region& upper, TileSet& tiles, Pieces& pieces,
             std::span<Replacement> replacements) {
  if (replacements.empty()) return false;
  return Replacing(lower, upper, tiles, pieces, replacements).run();
}

std::optional<Replacement> together(const Region& lower, const Region& upper,
                                    std::span<Replacement> each) {
  std::size_t count = 0;
  for (const Replacement& one : each) count += one.pieces.pieces.size();
  Replacement all;
  replace(lower, upper, all.tiles, all.pieces, each);
  if (all.pieces.pieces.size() != count) return {};
  return all;
}

}  // namespace loft
