// SPDX-License-Identifier: MIT
#include "reconstruct/link/link_orders.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "mesh/adjacency.h"
#include "mesh/box_tree.h"
#include "mesh/predicates.h"
#include "reconstruct/link/extract.h"
#include "reconstruct/link/moves.h"
#include "reconstruct/link/parts.h"
#include "reconstruct/link/replace.h"
#include "reconstruct/link/slide.h"
#include "reconstruct/link/tips.h"

namespace loft {

namespace {

std::string with_place(const LinkOrder& order, const std::string& problem) {
  return order.place.empty() ? problem : order.place + ": " + problem;
}

std::string name(const ContourId& id) {
  return "slice " + std::to_string(id.slice) + " contour " + std::to_string(id.contour);
}

/// Empty if the contour is there.
std::string complain(std::span<const Slice> slices, const ContourId& id) {
  if (id.slice >= slices.size())
    return "there is no slice " + std::to_string(id.slice) + "; the stack has " +
           std::to_string(slices.size()) + ", counted from 0";
  const std::size_t count = slices[id.slice].contours.size();
  if (id.contour >= count)
    return "there is no " + name(id) + "; that slice has " + std::to_string(count) +
           ", counted from 0";
  return {};
}

}  // namespace

std::vector<std::string> find_bad_orders(std::span<const Slice> slices,
                                         std::span<const LinkOrder> orders) {
  std::vector<double> heights;
  if (!orders.empty())
    for (const Slice& slice : slices) heights.push_back(slice.z);
  std::ranges::sort(heights);
  heights.erase(std::unique(heights.begin(), heights.end()), heights.end());
  const auto level = [&](const ContourId& id) {
    return std::ranges::lower_bound(heights, slices[id.slice].z) - heights.begin();
  };
  std::vector<std::string> problems;
  std::map<std::pair<ContourId, ContourId>, const LinkOrder*> seen;
  for (const LinkOrder& order : orders) {
    bool is_found = true;
    for (const ContourId& id : {order.from, order.to}) {
      const std::string problem = complain(slices, id);
      if (problem.empty()) continue;
      problems.push_back(with_place(order, problem));
      is_found = false;
    }
    if (!is_found) continue;
    const std::string both = name(order.from) + " and " + name(order.to);
    const auto step = level(order.from) - level(order.to);
    if (step != 1 && step != -1)
      problems.push_back(with_place(order, both + " are not in neighbouring slices"));
    const auto& from = slices[order.from.slice].contours[order.from.contour];
    const auto& to = slices[order.to.slice].contours[order.to.contour];
    if (from.label != to.label)
      problems.push_back(with_place(
          order, both + " have different labels, '" + from.label + "' and '" + to.label + "'"));
    const auto [other, is_new] = seen.try_emplace(std::minmax(order.from, order.to), &order);
    if (!is_new && other->second->is_link != order.is_link)
      problems.push_back(with_place(
          order,
          both + " are to be linked and not to be linked" +
              (other->second->place.empty() ? std::string() : ", see " + other->second->place)));
  }
  return problems;
}

std::string describe(const LinkOrder& order, const Refusal& refusal) {
  const std::string what = order.is_link ? "not linked with " : "not kept apart from ";
  return with_place(order, what + name(order.to) + ": " + refusal.reason);
}

std::vector<LinkOrder> orders_for(const std::optional<std::string>& label,
                                  std::span<const Slice> slices,
                                  std::span<const LinkOrder> orders) {
  std::vector<LinkOrder> chosen;
  for (const LinkOrder& order : orders)
    if (!label || slices[order.from.slice].contours[order.from.contour].label == *label)
      chosen.push_back(order);
  return chosen;
}

std::vector<std::vector<SlabOrder>> orders_of_slabs(std::span<const Region> regions,
                                                    std::span<const LinkOrder> orders,
                                                    std::vector<Refusal>& refusals) {
  std::vector<std::vector<SlabOrder>> of_slabs(regions.empty() ? 0 : regions.size() - 1);
  if (orders.empty()) return of_slabs;
  struct Found {
    std::uint32_t region = Origin::none;
    std::vector<std::uint32_t> loops;
    std::optional<std::uint32_t> line;
  };
  std::map<ContourId, Found> found;
  for (const LinkOrder& order : orders) {
    found[order.from];
    found[order.to];
  }
  for (std::uint32_t r = 0; r < regions.size(); ++r) {
    for (std::uint32_t i = 0; i < regions[r].loop_count(); ++i) {
      for (const std::uint32_t v : regions[r].loop(i)) {
        const Origin& origin = regions[r].origins[v];
        const auto place = found.find({origin.slice, origin.contour});
        if (origin.kind != VertexKind::contour || place == found.end()) continue;
        place->second.region = r;
        auto& loops = place->second.loops;
        if (loops.empty() || loops.back() != i) loops.push_back(i);
      }
    }
  }
  for (std::uint32_t r = 0; r < regions.size(); ++r) {
    for (std::uint32_t i = 0; i < regions[r].line_count(); ++i) {
      const Origin& origin = regions[r].line_origins[i];
      const auto place = found.find({origin.slice, origin.contour});
      if (place != found.end()) place->second = {r, {}, i};
    }
  }
  for (std::uint32_t i = 0; i < orders.size(); ++i) {
    const Found& from = found[orders[i].from];
    const Found& to = found[orders[i].to];
    if (from.region == Origin::none || to.region == Origin::none) {
      const ContourId& missing = from.region == Origin::none ? orders[i].from : orders[i].to;
      refusals.push_back({i, name(missing) + " bounds nothing after cleaning"});
    } else if (from.region + 1 == to.region) {
      of_slabs[from.region].push_back(
          {i, orders[i].is_link, from.loops, to.loops, from.line, to.line});
    } else if (to.region + 1 == from.region) {
      of_slabs[to.region].push_back(
          {i, orders[i].is_link, to.loops, from.loops, to.line, from.line});
    } else {
      refusals.push_back({i, "an empty slice lies between them"});
    }
  }
  return of_slabs;
}

namespace {

/// Parts that are tiled together.
struct Group {
  std::vector<std::uint32_t> lower;  // loops
  std::vector<std::uint32_t> upper;
  std::vector<std::uint32_t> parts;  // nodes of the graph
  bool is_ordered = false;           // an order has joined some of them
  cdt::Point shift;                  // by which the upper ones were moved to be tiled
};

class Ordering {
 public:
  Ordering(const Region& lower, const Region& upper, const Options& options,
           std::span<const SlabOrder> orders)
      : lower_(lower),
        upper_(upper),
        options_(options),
        orders_(orders),
        lower_count_(static_cast<std::uint32_t>(lower.points.size())),
        upper_count_(static_cast<std::uint32_t>(upper.points.size())) {}

  OrderedTiles run() {
    graph_ = find_parts(lower_, upper_);
    choose_orders();
    while (!build()) {
    }
    result_.pieces = find_pieces(lower_, upper_, result_.tiles);
    note_ordered_pieces();
    if (options_.link == LinkRule::automatic)
      slide(lower_, upper_, result_.tiles, result_.pieces, options_.max_shift);
    settle_ends();
    return std::move(result_);
  }

 private:
  [[nodiscard]] bool is_hole(Level level, std::uint32_t loop) const {
    const Region& region = level == Level::lower ? lower_ : upper_;
    const Extract extract(region, std::vector{loop}, true);
    const auto& points = extract.region().points;
    double area = 0;
    const auto vertices = extract.region().loop(0);
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      const cdt::Point p = points[vertices[i]];
      const cdt::Point q = points[vertices[(i + 1) % vertices.size()]];
      area += (p.x - points[0].x) * (q.y - points[0].y) - (p.y - points[0].y) * (q.x - points[0].x);
    }
    return area < 0;
  }

  [[nodiscard]] bool is_hole(Level level, std::span<const std::uint32_t> loops) const {
    return std::ranges::all_of(loops, [&](std::uint32_t loop) { return is_hole(level, loop); });
  }

  void refuse(const SlabOrder& order, std::string reason) {
    result_.refusals.push_back({order.order, std::move(reason)});
  }

  void choose_orders() {
    for (const SlabOrder& order : orders_) {
      const bool is_lower_hole = is_hole(Level::lower, order.lower);
      const bool is_upper_hole = is_hole(Level::upper, order.upper);
      if (is_lower_hole != is_upper_hole) {
        if (order.is_link) refuse(order, "one bounds a part, the other a hole");
      } else if (is_lower_hole) {
        hole_orders_.push_back(&order);
      } else {
        part_orders_.push_back(&order);
      }
    }
  }

  // Nodes of the graph: parts of the lower region, then those of the upper one.
  [[nodiscard]] std::uint32_t upper_node(std::uint32_t part) const {
    return graph_.lower_count + part;
  }
  [[nodiscard]] std::uint32_t node_count() const { return graph_.lower_count + graph_.upper_count; }
  [[nodiscard]] std::vector<PartGraph::Overlap> pairs(const SlabOrder& order) const {
    std::vector<PartGraph::Overlap> found;
    for (const std::uint32_t a : order.lower) {
      if (is_hole(Level::lower, a)) continue;
      for (const std::uint32_t b : order.upper)
        if (!is_hole(Level::upper, b))
          found.push_back({graph_.lower_part[a], graph_.upper_part[b]});
    }
    return found;
  }

  /// The set of each node, known by its smallest, if edges join nodes.
  [[nodiscard]] std::vector<std::uint32_t> sets(const std::set<PartGraph::Overlap>& edges) const {
    DisjointSets joined(node_count());
    for (const auto& edge : edges) joined.unite(edge.lower, upper_node(edge.upper));
    std::vector<std::uint32_t> set(node_count());
    for (std::uint32_t i = 0; i < set.size(); ++i) set[i] = joined.find(i);
    return set;
  }

  /// Tiles what the orders left make of the slab. False if some would meet: then an order less.
  bool build() {
    find_groups();
    result_.tiles = {};
    std::vector<std::uint32_t> owner;  // the group of each tile
    for (std::uint32_t g = 0; g < groups_.size(); ++g) {
      auto tiles = tile(groups_[g], g);
      if (!tiles) return drop_order(g, g, "no valid tiles were found for it");
      append(result_.tiles, *tiles, lower_count_ + upper_count_);
      result_.tiles.is_linked = result_.tiles.is_linked && tiles->is_linked;
      owner.resize(result_.tiles.tiles.size(), g);
    }
    if (const auto meeting = find_meeting(owner))
      return drop_order(meeting->first, meeting->second,
                        "its tiles would meet others between the slices");
    return true;
  }

  /// The first group is what overlap alone makes anyway; it is tiled as a whole.
  void find_groups() {
    const std::set<PartGraph::Overlap> overlaps(graph_.overlaps.begin(), graph_.overlaps.end());
    std::set<PartGraph::Overlap> edges;
    if (options_.link != LinkRule::none) edges = overlaps;
    for (const SlabOrder* order : part_orders_)
      for (const auto& pair : pairs(*order)) {
        if (order->is_link) edges.insert(pair);
        if (!order->is_link) edges.erase(pair);
      }
    const auto by_overlap = sets(overlaps);
    const auto by_order = sets(edges);
    const std::vector<bool> is_same = compare(by_overlap, by_order);

    groups_.assign(1, {});
    std::vector<std::uint32_t> group_of(node_count(), 0);
    for (std::uint32_t i = 0; i < node_count(); ++i) {
      if (is_same[by_order[i]] && options_.link != LinkRule::none) continue;
      if (by_order[i] == i) {
        group_of[i] = static_cast<std::uint32_t>(groups_.size());
        groups_.emplace_back();
      }
      group_of[i] = group_of[by_order[i]];
    }
    for (std::uint32_t i = 0; i < node_count(); ++i) groups_[group_of[i]].parts.push_back(i);
    for (std::uint32_t i = 0; i < lower_.loop_count(); ++i)
      groups_[group_of[graph_.lower_part[i]]].lower.push_back(i);
    for (std::uint32_t i = 0; i < upper_.loop_count(); ++i)
      groups_[group_of[upper_node(graph_.upper_part[i])]].upper.push_back(i);
    for (const SlabOrder* order : part_orders_)
      if (order->is_link)
        for (const auto& pair : pairs(*order))
          groups_[group_of[pair.lower]].is_ordered = group_of[pair.lower] != 0;
  }

  /// For each set of the second partition, by its smallest node, whether it is one of the first.
  [[nodiscard]] static std::vector<bool> compare(const std::vector<std::uint32_t>& first,
                                                 const std::vector<std::uint32_t>& second) {
    std::vector<std::uint32_t> first_size(first.size());
    std::vector<std::uint32_t> second_size(first.size());
    for (const std::uint32_t set : first) ++first_size[set];
    for (const std::uint32_t set : second) ++second_size[set];
    std::vector<bool> is_same(first.size(), true);
    for (std::size_t i = 0; i < first.size(); ++i)
      if (first[i] != second[i] || first_size[first[i]] != second_size[second[i]])
        is_same[second[i]] = false;
    return is_same;
  }

  [[nodiscard]] std::optional<TileSet> tile(Group& group, std::uint32_t index) {
    const Extract below(lower_, group.lower, true);
    const Extract above(upper_, group.upper, true);
    const auto embed = [&](TileSet tiles) {
      return embedded(std::move(tiles), below, above, lower_count_, upper_count_, true);
    };
    if (group.parts.empty()) return TileSet();
    if (index == 0) return embed(loft::tile(below.region(), above.region()));
    if (group.lower.empty() || group.upper.empty()) {
      TileSet tiles = tile_apart(below.region(), above.region());
      tiles.is_linked = true;
      return embed(std::move(tiles));
    }
    for (const cdt::Point shift : shifts(group)) {
      auto tiles = tile_moved(below.region(), above.region(), shift);
      if (!tiles || !is_one(below.region(), above.region(), *tiles)) continue;
      group.shift = shift;
      return embed(std::move(*tiles));
    }
    if (auto made = move_by_loops(lower_, upper_, whole(group))) {
      group.shift = made->piece.shift;
      return std::move(made->tiles);
    }
    return std::nullopt;
  }

  /// What to try: parts that an order has joined, over each other; then as they are.
  [[nodiscard]] std::vector<cdt::Point> shifts(const Group& group) const {
    if (!group.is_ordered) return {{}};
    return {offset(whole(group)), {}};
  }

  /// A group as one piece.
  [[nodiscard]] Piece whole(const Group& group) const {
    Piece piece;
    piece.lower.loops = group.lower;
    piece.upper.loops = group.upper;
    measure(lower_, piece.lower);
    measure(upper_, piece.upper);
    return piece;
  }

  /// Whether all outer loops are joined.
  [[nodiscard]] static bool is_one(const Region& lower, const Region& upper, const TileSet& tiles) {
    const Pieces pieces = find_pieces(lower, upper, tiles);
    return std::ranges::count_if(pieces.pieces, &Piece::is_solid) == 1;
  }

  /// Two groups whose tiles meet.
  [[nodiscard]] std::optional<std::pair<std::uint32_t, std::uint32_t>> find_meeting(
      const std::vector<std::uint32_t>& owner) const {
    if (groups_.size() < 2) return std::nullopt;
    std::vector<Corners> places;
    std::vector<Box3> boxes;
    for (const Tile& tile : result_.tiles.tiles) {
      Corners& corners = places.emplace_back();
      for (unsigned i = 0; i < 3; ++i)
        corners[i] = place_of(lower_, upper_, result_.tiles.inner, tile.nodes[i]);
      boxes.push_back(box_around(corners[0], corners[1], corners[2]));
    }
    std::set<std::pair<std::uint32_t, std::uint32_t>> found;
    BoxTree(boxes).for_each_pair([&](std::uint32_t i, std::uint32_t j) {
      if (owner[i] != owner[j] && triangles_meet(places[i], places[j]))
        found.insert(std::minmax(owner[i], owner[j]));
    });
    if (found.empty()) return std::nullopt;
    return *found.begin();
  }

  /// Refuses the last order that takes part in one of two groups; links before others.
  bool drop_order(std::uint32_t one, std::uint32_t other, const std::string& reason) {
    const auto takes_part = [&](const SlabOrder* order) {
      return std::ranges::any_of(pairs(*order), [&](const PartGraph::Overlap& pair) {
        return std::ranges::any_of(std::array{one, other}, [&](std::uint32_t group) {
          const auto& parts = groups_[group].parts;
          return std::ranges::find(parts, pair.lower) != parts.end() ||
                 std::ranges::find(parts, upper_node(pair.upper)) != parts.end();
        });
      });
    };
    for (const bool is_link : {true, false}) {
      for (std::size_t i = part_orders_.size(); i-- > 0;) {
        if (part_orders_[i]->is_link != is_link || !takes_part(part_orders_[i])) continue;
        refuse(*part_orders_[i], reason);
        part_orders_.erase(part_orders_.begin() + static_cast<std::ptrdiff_t>(i));
        return false;
      }
    }
    return true;
  }

  /// Pieces that overlap alone would not have made.
  void note_ordered_pieces() {
    const auto has = [](const std::vector<std::uint32_t>& loops, const Footprint& footprint) {
      return footprint.is_empty() ||
             std::ranges::find(loops, footprint.loops.front()) != loops.end();
    };
    for (std::size_t g = 1; g < groups_.size(); ++g) {
      for (Piece& piece : result_.pieces.pieces) {
        if (!has(groups_[g].lower, piece.lower) || !has(groups_[g].upper, piece.upper)) continue;
        piece.reason = LinkReason::order;
        piece.shift = groups_[g].shift;
      }
    }
    // What overlap links anyway is not taken apart again, where an order asks for it.
    for (const SlabOrder* order : part_orders_) {
      const std::uint32_t piece = piece_of(Level::lower, order->lower);
      if (order->is_link && piece == piece_of(Level::upper, order->upper) &&
          is_tangle(result_.pieces.pieces[piece]))
        result_.pieces.pieces[piece].reason = LinkReason::order;
    }
  }

  [[nodiscard]] static bool is_tangle(const Piece& piece) {
    return piece.lower.parts > 1 && piece.upper.parts > 1;
  }

  [[nodiscard]] std::uint32_t piece_of(Level level, std::span<const std::uint32_t> loops) const {
    const auto& pieces = result_.pieces.pieces;
    for (std::uint32_t i = 0; i < pieces.size(); ++i) {
      const auto& own = pieces[i].footprint(level).loops;
      if (std::ranges::find(own, loops.front()) != own.end()) return i;
    }
    return Origin::none;
  }

  /// What orders say about ends: cavities to link, and what must not be linked later on.
  void settle_ends() {
    const auto& pieces = result_.pieces.pieces;
    for (const SlabOrder& order : orders_) {
      const EndLink ends{piece_of(Level::lower, order.lower), piece_of(Level::upper, order.upper),
                         LinkReason::order};
      const bool are_ends = pieces[ends.lower].is_end() && pieces[ends.upper].is_end();
      const bool is_of_holes = std::ranges::find(hole_orders_, &order) != hole_orders_.end();
      const bool is_any_end = pieces[ends.lower].is_end() || pieces[ends.upper].is_end();
      if (is_any_end && !order.is_link) result_.forbidden.push_back(ends);
      if (!is_of_holes || (ends.lower == ends.upper) == order.is_link) continue;
      if (are_ends && order.is_link) {
        result_.wanted.push_back(ends);
      } else if (order.is_link) {
        refuse(order, "a hole that goes on elsewhere can't be linked with another one");
      } else if (ends.lower == ends.upper) {
        refuse(order, "holes that overlap can't be kept apart; link the parts around them");
      }
    }
  }

  const Region& lower_;
  const Region& upper_;
  const Options& options_;
  std::span<const SlabOrder> orders_;
  std::uint32_t lower_count_;
  std::uint32_t upper_count_;
  PartGraph graph_;
  std::vector<const SlabOrder*> part_orders_;  // not refused so far
  std::vector<const SlabOrder*> hole_orders_;
  std::vector<Group> groups_;
  OrderedTiles result_;
};

}  // namespace

OrderedTiles tile_by_orders(const Region& lower, const Region& upper, const Options& options,
                            std::span<const SlabOrder> all_orders, TileWorkspace& workspace) {
  std::vector<SlabOrder> orders;
  for (const SlabOrder& order : all_orders)
    if (!order.has_line()) orders.push_back(order);
  if (auto tips = find_tips(lower, upper); !tips.empty()) {
    Options unmoved = options;  // what slides must meet no tip
    if (options.link == LinkRule::automatic) unmoved.link = LinkRule::overlap;
    auto all = tile_beside(lower, upper, std::move(tips), orders,
                           [&](const Region& below, const Region& above, auto left) {
                             return tile_by_orders(below, above, unmoved, left, workspace);
                           });
    if (all && options.link == LinkRule::automatic)
      slide(lower, upper, all->tiles, all->pieces, options.max_shift);
    if (all) return std::move(*all);
  }
  const bool is_plain = orders.empty() && options.link != LinkRule::none;
  const bool is_end = !lower.has_loops() || !upper.has_loops();
  if (!is_plain && !is_end) return Ordering(lower, upper, options, orders).run();
  OrderedTiles plain;
  plain.tiles = tile(lower, upper, workspace);
  plain.pieces = find_pieces(lower, upper, plain.tiles);
  if (options.link == LinkRule::automatic)
    slide(lower, upper, plain.tiles, plain.pieces, options.max_shift);
  return plain;
}

}  // namespace loft
