// SPDX-License-Identifier: MIT
#include "reconstruct/live/retile.h"

#include <algorithm>
#include <map>
#include <utility>

#include "reconstruct/link/extract.h"
#include "reconstruct/link/replace.h"
#include "reconstruct/link/slide.h"
#include "reconstruct/plane/tile_grid.h"

namespace loft {

namespace {

bool is_same_loop(const Region& a, std::uint32_t i, const Region& b, std::uint32_t j) {
  const auto is_same_vertex = [&](std::uint32_t v, std::uint32_t w) {
    return a.points[v] == b.points[w] && is_same_in_slice(a.origins[v], b.origins[w]);
  };
  return std::ranges::equal(a.loop(i), b.loop(j), is_same_vertex);
}

void add(cdt::Box& box, const cdt::Box& other) {
  if (other.is_empty()) return;
  box.add(other.low);
  box.add(other.high);
}

class Retiling {
 public:
  Retiling(const SlabChange& change, const Options& options, TileWorkspace& workspace)
      : change_(change), options_(options), workspace_(workspace) {}

  std::optional<Retiled> run() {
    if (!is_plain()) return {};
    match_points();
    find_box();
    if (!find_pieces_concerned()) return {};
    keep_tiles();
    if (!has_none_concerned() && !make_tiles()) return {};
    result_.pieces = find_pieces(change_.lower, change_.upper, result_.tiles);
    result_.tiles.is_plain = true;
    if (options_.link == LinkRule::automatic) {
      slide(change_.lower, change_.upper, result_.tiles, result_.pieces, options_.max_shift);
      if (!result_.tiles.is_plain) return {};
    }
    return std::move(result_);
  }

 private:
  [[nodiscard]] static bool all_by_overlap(const Pieces& pieces) {
    return std::ranges::all_of(
        pieces.pieces, [](const Piece& piece) { return piece.reason == LinkReason::overlap; });
  }

  /// Whether the old tiles are those of the overlay alone, piece by piece.
  [[nodiscard]] bool is_plain() const {
    return options_.link != LinkRule::none && change_.old_tiles.is_plain &&
           all_by_overlap(change_.old_pieces) && is_simple(change_.old_lower) &&
           is_simple(change_.old_upper) && is_simple(change_.lower) && is_simple(change_.upper) &&
           doubt(change_.old_lower, change_.old_upper) == doubt(change_.lower, change_.upper);
  }

  [[nodiscard]] bool is_lower_changed() const { return change_.changed == Level::lower; }
  [[nodiscard]] const Region& old_slice() const {
    return is_lower_changed() ? change_.old_lower : change_.old_upper;
  }
  [[nodiscard]] const Region& new_slice() const {
    return is_lower_changed() ? change_.lower : change_.upper;
  }

  /// Where points and loops of the old slice are in the new one.
  void match_points() {
    new_points_.assign(old_slice().points.size(), Origin::none);
    new_loops_.assign(old_slice().loop_count(), Origin::none);
    for (std::uint32_t i = 0; i < change_.old_loops.size(); ++i) {
      const std::uint32_t old = change_.old_loops[i];
      if (old == Origin::none) continue;
      new_loops_[old] = i;
      const auto from = old_slice().loop(old);
      const auto to = new_slice().loop(i);
      for (std::size_t k = 0; k < from.size(); ++k) new_points_[from[k]] = to[k];
    }
  }

  /// Around all loops that came or went, and what they might touch.
  void find_box() {
    const auto add = [this](const Region& region, std::uint32_t i) {
      for (const std::uint32_t v : region.loop(i)) box_.add(region.points[v]);
    };
    for (std::uint32_t i = 0; i < new_loops_.size(); ++i)
      if (new_loops_[i] == Origin::none) add(old_slice(), i);
    for (std::uint32_t i = 0; i < change_.old_loops.size(); ++i)
      if (change_.old_loops[i] == Origin::none) add(new_slice(), i);
    if (box_.is_empty()) return;
    const double contact = loft::contact(change_.lower, change_.upper);
    box_.low = {box_.low.x - contact, box_.low.y - contact};
    box_.high = {box_.high.x + contact, box_.high.y + contact};
  }

  void note_footprints() {
    const auto place = [this](std::uint32_t node) {
      return place_of(change_.old_lower, change_.old_upper, change_.old_tiles.inner, node);
    };
    footprints_.reserve(change_.old_tiles.tiles.size());
    for (const Tile& tile : change_.old_tiles.tiles)
      footprints_.push_back(
          footprint({place(tile.nodes[0]), place(tile.nodes[1]), place(tile.nodes[2])}));
  }

  [[nodiscard]] bool is_concerned(const Reach& reach) const {
    return is_concerned_[old_piece_of_[reach.node]];
  }

  /// The pieces that have tiles in the one box, or that reach into the other one, are concerned,
  /// too. Whether there were any more.
  bool add_pieces(const cdt::Box& tiles_in, const cdt::Box& reaches_in) {
    const std::vector<std::uint32_t>& of_tile = change_.old_pieces.of_tile;
    bool is_new = false;
    for (std::size_t t = 0; t < of_tile.size() && !tiles_in.is_empty(); ++t) {
      if (is_concerned_[of_tile[t]] || !boxes_meet(footprints_[t], tiles_in)) continue;
      is_concerned_[of_tile[t]] = is_new = true;
    }
    for (const Reach& reach : change_.old_tiles.reaches) {
      if (is_concerned(reach) || !boxes_meet(reach.box, reaches_in)) continue;
      is_concerned_[old_piece_of_[reach.node]] = is_new = true;
    }
    return is_new;
  }

  /// The pieces that those concerned so far may have decided, or were decided by.
  bool spread() {
    cdt::Box reaches;
    for (const Reach& reach : change_.old_tiles.reaches)
      if (is_concerned(reach)) add(reaches, reach.box);
    cdt::Box tiles = reaches;
    for (std::size_t t = 0; t < change_.old_tiles.tiles.size(); ++t)
      if (is_concerned_[change_.old_pieces.of_tile[t]]) add(tiles, footprints_[t]);
    return add_pieces(reaches, tiles);
  }

  void note_old_pieces() {
    old_piece_of_.assign(change_.old_lower.points.size() + change_.old_upper.points.size(),
                         Origin::none);
    for (std::size_t t = 0; t < change_.old_tiles.tiles.size(); ++t)
      for (const std::uint32_t node : change_.old_tiles.tiles[t].nodes)
        if (node < old_piece_of_.size()) old_piece_of_[node] = change_.old_pieces.of_tile[t];
  }

  /// False if they cannot be tiled together.
  bool find_pieces_concerned() {
    const Pieces& pieces = change_.old_pieces;
    for (const Piece& piece : pieces.pieces) is_concerned_.push_back(piece.lean != cdt::Point{});
    note_old_pieces();
    if (box_.is_empty() && has_none_concerned()) return true;
    note_footprints();
    if (!box_.is_empty()) add_pieces(box_, box_);
    if (!change_.old_tiles.reaches.empty())
      while (spread()) {
      }
    std::optional<bool> is_solid;
    for (std::size_t i = 0; i < is_concerned_.size(); ++i) {
      if (!is_concerned_[i]) continue;
      if (is_solid.value_or(pieces.pieces[i].is_solid) != pieces.pieces[i].is_solid) return false;
      is_solid = pieces.pieces[i].is_solid;
    }
    if (!is_solid) return false;  // what came is alone
    is_solid_ = *is_solid;
    return true;
  }

  [[nodiscard]] bool has_none_concerned() const {
    return std::ranges::find(is_concerned_, true) == is_concerned_.end();
  }

  [[nodiscard]] std::uint32_t lower_count() const {
    return static_cast<std::uint32_t>(change_.lower.points.size());
  }
  [[nodiscard]] std::uint32_t contour_count() const {
    return lower_count() + static_cast<std::uint32_t>(change_.upper.points.size());
  }

  /// The number that a node of an old tile has now.
  std::uint32_t renumbered(std::uint32_t node) {
    const auto old_lower_count = static_cast<std::uint32_t>(change_.old_lower.points.size());
    if (node < old_lower_count) return is_lower_changed() ? new_points_[node] : node;
    node -= old_lower_count;
    if (node < change_.old_upper.points.size())
      return lower_count() + (is_lower_changed() ? node : new_points_[node]);
    node -= static_cast<std::uint32_t>(change_.old_upper.points.size());
    std::uint32_t& inner = new_inner_[node];
    if (inner == Origin::none) {
      inner = static_cast<std::uint32_t>(result_.tiles.inner.size());
      result_.tiles.inner.push_back(change_.old_tiles.inner[node]);
    }
    return contour_count() + inner;
  }

  void keep_tiles() {
    const auto& tiles = change_.old_tiles.tiles;
    new_inner_.assign(change_.old_tiles.inner.size(), Origin::none);
    for (std::uint32_t t = 0; t < tiles.size(); ++t) {
      if (is_concerned_[change_.old_pieces.of_tile[t]]) {
        result_.gone.push_back(t);
        continue;
      }
      result_.kept.push_back(t);
      Tile tile = tiles[t];
      for (std::uint32_t& node : tile.nodes) node = renumbered(node);
      result_.tiles.tiles.push_back(tile);
    }
    for (Reach reach : change_.old_tiles.reaches) {
      if (is_concerned(reach)) continue;
      reach.node = renumbered(reach.node);
      result_.tiles.reaches.push_back(reach);
    }
  }

  /// The loops that the pieces concerned have, or had, in one of the slices; and new ones there.
  [[nodiscard]] std::vector<std::uint32_t> loops(Level level) const {
    std::vector<std::uint32_t> all;
    for (std::size_t i = 0; i < is_concerned_.size(); ++i) {
      if (!is_concerned_[i]) continue;
      for (const std::uint32_t loop : change_.old_pieces.pieces[i].footprint(level).loops) {
        const std::uint32_t now = level == change_.changed ? new_loops_[loop] : loop;
        if (now != Origin::none) all.push_back(now);
      }
    }
    if (level == change_.changed)
      for (std::uint32_t i = 0; i < change_.old_loops.size(); ++i)
        if (change_.old_loops[i] == Origin::none) all.push_back(i);
    std::ranges::sort(all);
    return all;
  }

  bool make_tiles() {
    const Extract lower(change_.lower, loops(Level::lower), is_solid_);
    const Extract upper(change_.upper, loops(Level::upper), is_solid_);
    auto tiles = tile_plain(lower.region(), upper.region(), doubt(change_.lower, change_.upper),
                            is_solid_, workspace_);
    if (!tiles) return false;
    tiles = embedded(std::move(*tiles), lower, upper, lower_count(),
                     contour_count() - lower_count(), is_solid_);
    if (!keeps_clear(*tiles)) return false;
    append(result_.tiles, *tiles, contour_count());
    return has_all_contours();
  }

  /// Whether the new tiles and those that are kept are out of each other's reach.
  [[nodiscard]] bool keeps_clear(const TileSet& made) const {
    cdt::Box reaches;
    for (const Reach& reach : made.reaches) add(reaches, reach.box);
    cdt::Box tiles = reaches;
    for (const Tile& tile : made.tiles) add(tiles, new_footprint(made, tile));
    return std::ranges::none_of(result_.tiles.reaches,
                                [&](const Reach& kept) { return boxes_meet(kept.box, tiles); }) &&
           (reaches.is_empty() || std::ranges::none_of(result_.kept, [&](std::uint32_t kept) {
              return boxes_meet(footprints_[kept], reaches);
            }));
  }
  [[nodiscard]] cdt::Box new_footprint(const TileSet& tiles, const Tile& tile) const {
    const auto place = [&](std::uint32_t node) {
      return place_of(change_.lower, change_.upper, tiles.inner, node);
    };
    return footprint({place(tile.nodes[0]), place(tile.nodes[1]), place(tile.nodes[2])});
  }

  /// Each contour edge has one tile, or the loops did not fit together.
  [[nodiscard]] bool has_all_contours() const {
    std::size_t count = 0;
    for (const Tile& tile : result_.tiles.tiles) {
      for (unsigned i = 0; i < 3; ++i) {
        const std::uint32_t a = tile.nodes[i];
        const std::uint32_t b = tile.nodes[(i + 1) % 3];
        if (std::max(a, b) < contour_count() && (a < lower_count()) == (b < lower_count())) ++count;
      }
    }
    return count == contour_count();
  }

  const SlabChange& change_;
  const Options& options_;
  TileWorkspace& workspace_;
  Retiled result_;
  cdt::Box box_;
  std::vector<std::uint32_t> new_points_;    // of each point of the old slice, or none
  std::vector<std::uint32_t> new_loops_;     // of each loop of it
  std::vector<std::uint32_t> new_inner_;     // of each old inner vertex
  std::vector<std::uint32_t> old_piece_of_;  // of each point of the old slices
  std::vector<cdt::Box> footprints_;         // of the old tiles
  std::vector<bool> is_concerned_;           // of each old piece
  bool is_solid_ = true;                     // those concerned are
};

}  // namespace

std::vector<std::uint32_t> match_loops(const Region& region, const Region& other) {
  std::map<cdt::Point, std::uint32_t> starts;  // simple regions have each point once
  for (std::uint32_t i = 0; i < other.loop_count(); ++i)
    starts.emplace(other.points[other.loop(i)[0]], i);
  std::vector<std::uint32_t> matches(region.loop_count(), Origin::none);
  for (std::uint32_t i = 0; i < region.loop_count(); ++i) {
    const auto found = starts.find(region.points[region.loop(i)[0]]);
    if (found != starts.end() && is_same_loop(region, i, other, found->second))
      matches[i] = found->second;
  }
  return matches;
}

std::optional<Retiled> retile(const SlabChange& change, const Options& options,
                              TileWorkspace& workspace) {
  return Retiling(change, options, workspace).run();
}

}  // namespace loft
