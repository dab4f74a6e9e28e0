// SPDX-License-Identifier: MIT
#include "reconstruct/link/tips.h"

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

#include "mesh/box_tree.h"
#include "reconstruct/link/extract.h"
#include "reconstruct/link/parts.h"
#include "reconstruct/link/replace.h"
#include "reconstruct/tile/tip_tiles.h"

namespace loft {

namespace {

/// Around points of a region, in the plane.
Box3 box(const Region& region, std::span<const std::uint32_t> vertices, double more) {
  cdt::Box box;
  for (const std::uint32_t v : vertices) box.add(region.points[v]);
  return {{box.low.x - more, box.low.y - more, 0}, {box.high.x + more, box.high.y + more, 0}};
}

bool is_inside(const Box3& inner, const Box3& outer) {
  return outer.low[0] <= inner.low[0] && inner.high[0] <= outer.high[0] &&
         outer.low[1] <= inner.low[1] && inner.high[1] <= outer.high[1];
}

class TipFinder {
 public:
  TipFinder(const Region& lower, const Region& upper)
      : lower_(lower), upper_(upper), contact_(contact(lower, upper)) {}

  std::vector<Tip> run() {
    graph_ = find_parts(lower_, upper_);
    for (const Level level : {Level::lower, Level::upper})
      if (region(level).has_loops() && region(other(level)).line_count() != 0) find(level);
    return std::move(tips_);
  }

 private:
  [[nodiscard]] const Region& region(Level level) const {
    return level == Level::lower ? lower_ : upper_;
  }

  /// The loops of each part that overlaps nothing.
  [[nodiscard]] std::vector<std::vector<std::uint32_t>> ending_parts(Level level) const {
    const bool is_lower = level == Level::lower;
    const auto& part_of = is_lower ? graph_.lower_part : graph_.upper_part;
    std::vector<std::vector<std::uint32_t>> loops(is_lower ? graph_.lower_count
                                                           : graph_.upper_count);
    for (std::uint32_t i = 0; i < part_of.size(); ++i)
      if (part_of[i] != Origin::none) loops[part_of[i]].push_back(i);
    for (const PartGraph::Overlap& overlap : graph_.overlaps)
      loops[is_lower ? overlap.lower : overlap.upper].clear();
    std::erase_if(loops, [](const auto& part) { return part.empty(); });
    return loops;
  }

  void find(Level level) {
    const Region& beyond = region(other(level));
    std::vector<Box3> boxes;
    for (std::size_t i = 0; i < beyond.line_count(); ++i)
      boxes.push_back(box(beyond, beyond.line(i), 0));
    const BoxTree tree(boxes);
    for (auto& loops : ending_parts(level)) {
      const Extract part(region(level), loops, true);
      const Region& extract = part.region();
      const Box3 here = box(extract, extract.loop_vertices, contact_);
      std::vector<std::uint32_t> lines;
      tree.for_each_meeting(here, [&](std::uint32_t i) {
        if (is_inside(boxes[i], here)) lines.push_back(i);
      });
      std::ranges::sort(lines);
      if (!lines.empty()) add(level, part, std::move(loops), lines);
    }
  }

  void add(Level level, const Extract& part, std::vector<std::uint32_t> loops,
           const std::vector<std::uint32_t>& lines) {
    const Extract beyond(region(other(level)), {}, true, lines);
    const Extract& below = level == Level::lower ? part : beyond;
    const Extract& above = level == Level::lower ? beyond : part;
    auto made = tile_tip(below.region(), above.region(), contact_);
    if (!made) return;
    Tip tip{level, std::move(loops), {}, {}};
    for (const std::uint32_t i : made->lines) tip.lines.push_back(lines[i]);
    tip.tiles = embedded(std::move(made->tiles), below, above,
                         static_cast<std::uint32_t>(lower_.points.size()),
                         static_cast<std::uint32_t>(upper_.points.size()), true);
    tips_.push_back(std::move(tip));
  }

  const Region& lower_;
  const Region& upper_;
  double contact_;
  PartGraph graph_;
  std::vector<Tip> tips_;
};

/// The loops of a region that belong to no tip, and where each is among them.
struct Rest {
  std::vector<std::uint32_t> loops;
  std::vector<std::uint32_t> number;  // of each loop of the region, or none
};

Rest rest_of(const Region& region, Level level, std::span<const Tip> tips) {
  Rest rest;
  rest.number.resize(region.loop_count());
  for (const Tip& tip : tips)
    if (tip.level == level)
      for (const std::uint32_t i : tip.loops) rest.number[i] = Origin::none;
  for (std::uint32_t i = 0; i < rest.number.size(); ++i) {
    if (rest.number[i] == Origin::none) continue;
    rest.number[i] = static_cast<std::uint32_t>(rest.loops.size());
    rest.loops.push_back(i);
  }
  return rest;
}

std::vector<std::uint32_t> renumbered(const std::vector<std::uint32_t>& loops,
                                      const std::vector<std::uint32_t>& number) {
  std::vector<std::uint32_t> found;
  for (const std::uint32_t i : loops)
    if (number[i] != Origin::none) found.push_back(number[i]);
  return found;
}

class Beside {
 public:
  Beside(const Region& lower, const Region& upper, std::vector<Tip> tips)
      : lower_(lower),
        upper_(upper),
        tips_(std::move(tips)),
        below_(rest_of(lower, Level::lower, tips_)),
        above_(rest_of(upper, Level::upper, tips_)) {}

  std::optional<OrderedTiles> run(std::span<const SlabOrder> orders, const TileRest& tile_rest) {
    std::vector<Refusal> refusals;
    std::vector<SlabOrder> left = orders_left(orders, refusals);
    OrderedTiles all = rest(left, tile_rest);
    bool is_met = meets_tip(all.tiles);
    if (is_met && !left.empty()) {  // parts that orders move go anywhere
      for (const SlabOrder& order : left)
        if (order.is_link)
          refusals.push_back({order.order, "tiles would meet others between the slices"});
      std::erase_if(left, &SlabOrder::is_link);
      all = rest(left, tile_rest);
      is_met = meets_tip(all.tiles);
    }
    if (is_met) return {};
    all.refusals.insert(all.refusals.begin(), refusals.begin(), refusals.end());
    for (const Tip& tip : tips_) add(tip, all);
    sort(all);
    return all;
  }

 private:
  [[nodiscard]] std::uint32_t lower_count() const {
    return static_cast<std::uint32_t>(lower_.points.size());
  }
  [[nodiscard]] std::uint32_t upper_count() const {
    return static_cast<std::uint32_t>(upper_.points.size());
  }

  /// What is no tip, as a part of the slab.
  [[nodiscard]] OrderedTiles rest(std::span<const SlabOrder> orders,
                                  const TileRest& tile_rest) const {
    const Extract below(lower_, below_.loops, true);
    const Extract above(upper_, above_.loops, true);
    OrderedTiles all = tile_rest(below.region(), above.region(), orders);
    all.tiles = embedded(std::move(all.tiles), below, above, lower_count(), upper_count(), true);
    all.tiles.is_plain = false;
    for (Piece& piece : all.pieces.pieces) {
      for (std::uint32_t& loop : piece.lower.loops) loop = below_.loops[loop];
      for (std::uint32_t& loop : piece.upper.loops) loop = above_.loops[loop];
    }
    return all;
  }

  [[nodiscard]] bool meets_tip(const TileSet& tiles) const {
    const auto places = [&](const TileSet& of, const Tile& tile) {
      Corners corners;
      for (unsigned i = 0; i < 3; ++i)
        corners[i] = place_of(lower_, upper_, of.inner, tile.nodes[i]);
      return corners;
    };
    const auto around = [](const Corners& c) { return box_around(c[0], c[1], c[2]); };
    std::vector<Corners> corners;
    std::vector<Box3> boxes;
    for (const Tip& tip : tips_) {
      for (const Tile& tile : tip.tiles.tiles) {
        corners.push_back(places(tip.tiles, tile));
        boxes.push_back(around(corners.back()));
      }
    }
    const BoxTree tree(boxes);
    return std::ranges::any_of(tiles.tiles, [&](const Tile& tile) {
      const Corners here = places(tiles, tile);
      bool is_found = false;
      tree.for_each_meeting(around(here), [&](std::uint32_t i) {
        is_found = is_found || triangles_meet(here, corners[i]);
      });
      return is_found;
    });
  }

  [[nodiscard]] std::vector<SlabOrder> orders_left(std::span<const SlabOrder> orders,
                                                   std::vector<Refusal>& refusals) const {
    std::vector<SlabOrder> left;
    for (const SlabOrder& order : orders) {
      SlabOrder one{order.order, order.is_link, renumbered(order.lower, below_.number),
                    renumbered(order.upper, above_.number)};
      if (!one.lower.empty() && !one.upper.empty()) {
        left.push_back(std::move(one));
      } else if (order.is_link) {
        refusals.push_back({order.order,
                            "one of them ends in a point or a line of the other slice; leave that "
                            "out to link them"});
      }
    }
    return left;
  }

  void add(const Tip& tip, OrderedTiles& all) const {
    append(all.tiles, tip.tiles, lower_count() + upper_count());
    const auto number = static_cast<std::uint32_t>(all.pieces.pieces.size());
    all.pieces.of_tile.resize(all.tiles.tiles.size(), number);
    Piece& piece = all.pieces.pieces.emplace_back();
    const bool is_lower = tip.level == Level::lower;
    Footprint& part = is_lower ? piece.lower : piece.upper;
    part.loops = tip.loops;
    piece.is_solid = measure(is_lower ? lower_ : upper_, part);
    (is_lower ? piece.upper : piece.lower).lines = tip.lines;
  }

  /// The pieces by their places; what knows them by their numbers follows.
  void sort(OrderedTiles& all) const {
    std::vector<std::uint32_t>& of_tile = all.pieces.of_tile;
    const std::size_t tile_count = of_tile.size();
    const auto piece_count = static_cast<std::uint32_t>(all.pieces.pieces.size());
    for (std::uint32_t i = 0; i < piece_count; ++i) of_tile.push_back(i);
    sort_pieces(lower_, upper_, all.pieces);
    const std::vector<std::uint32_t> now(of_tile.begin() + static_cast<std::ptrdiff_t>(tile_count),
                                         of_tile.end());
    of_tile.resize(tile_count);
    for (auto* links : {&all.wanted, &all.forbidden})
      for (EndLink& link : *links) link = {now[link.lower], now[link.upper], link.reason};
  }

  const Region& lower_;
  const Region& upper_;
  std::vector<Tip> tips_;
  Rest below_;
  Rest above_;
};

}  // namespace

std::vector<Tip> find_tips(const Region& lower, const Region& upper) {
  const bool is_possible = (lower.has_loops() && upper.line_count() != 0) ||
                           (upper.has_loops() && lower.line_count() != 0);
  if (!is_possible) return {};
  return TipFinder(lower, upper).run();
}

std::optional<OrderedTiles> tile_beside(const Region& lower, const Region& upper,
                                        std::vector<Tip> tips, std::span<const SlabOrder> orders,
                                        const TileRest& tile_rest) {
  return Beside(lower, upper, std::move(tips)).run(orders, tile_rest);
}

std::vector<std::uint32_t> unused_lines(const Region& region, const Pieces* below,
                                        const Pieces* above) {
  std::vector<bool> is_used(region.line_count());
  if (below != nullptr)
    for (const Piece& piece : below->pieces)
      for (const std::uint32_t i : piece.upper.lines) is_used[i] = true;
  if (above != nullptr)
    for (const Piece& piece : above->pieces)
      for (const std::uint32_t i : piece.lower.lines) is_used[i] = true;
  std::vector<std::uint32_t> unused;
  for (std::uint32_t i = 0; i < is_used.size(); ++i)
    if (!is_used[i]) unused.push_back(i);
  return unused;
}

}  // namespace loft
