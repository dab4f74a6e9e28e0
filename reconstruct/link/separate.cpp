// SPDX-License-Identifier: MIT
#include "reconstruct/link/separate.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "mesh/adjacency.h"
#include "reconstruct/link/bounds.h"
#include "reconstruct/link/extract.h"
#include "reconstruct/link/moves.h"
#include "reconstruct/link/parts.h"
#include "reconstruct/link/replace.h"

namespace loft {

namespace {

using cdt::Point;

/// An overlap is little if it is less than that share of the largest that each of its parts has.
constexpr double little = 0.5;

/// Parts of both slices, by nodes: those of the lower one first.
std::vector<std::uint32_t> group_parts(const PartGraph& graph) {
  std::vector<double> most(graph.lower_count + graph.upper_count);
  const auto nodes = [&](const PartGraph::Overlap& overlap) {
    return std::pair(overlap.lower, graph.lower_count + overlap.upper);
  };
  for (std::size_t i = 0; i < graph.overlaps.size(); ++i) {
    const auto [a, b] = nodes(graph.overlaps[i]);
    most[a] = std::max(most[a], graph.areas[i]);
    most[b] = std::max(most[b], graph.areas[i]);
  }
  DisjointSets sets(most.size());
  for (std::size_t i = 0; i < graph.overlaps.size(); ++i) {
    const auto [a, b] = nodes(graph.overlaps[i]);
    if (is_within(little * std::min(most[a], most[b]), graph.areas[i])) sets.unite(a, b);
  }
  std::vector<std::uint32_t> group;
  for (std::uint32_t i = 0; i < most.size(); ++i) group.push_back(sets.find(i));
  return group;
}

bool has_all(const std::vector<std::uint32_t>& parts) {
  return std::ranges::find(parts, Origin::none) == parts.end();
}

/// The groups of a piece as pieces; none if there is one only, or one without a part of each slice.
std::vector<Piece> groups_of(const Region& lower, const Region& upper, const Piece& piece) {
  const Extract below(lower, piece.lower.loops, piece.is_solid);
  const Extract above(upper, piece.upper.loops, piece.is_solid);
  // Loops that touch go around what is solid: one may bound several parts of a cavity.
  if (!piece.is_solid && !(is_simple(below.region()) && is_simple(above.region()))) return {};
  const PartGraph graph = find_parts(below.region(), above.region());
  if (!has_all(graph.lower_part) || !has_all(graph.upper_part)) return {};
  const std::vector<std::uint32_t> group = group_parts(graph);
  std::vector<Piece> all(group.size());
  for (std::size_t i = 0; i < piece.lower.loops.size(); ++i)
    all[group[graph.lower_part[i]]].lower.loops.push_back(piece.lower.loops[i]);
  for (std::size_t i = 0; i < piece.upper.loops.size(); ++i)
    all[group[graph.lower_count + graph.upper_part[i]]].upper.loops.push_back(piece.upper.loops[i]);
  std::vector<Piece> groups;
  for (std::uint32_t g = 0; g < all.size(); ++g) {
    if (group[g] != g) continue;
    Piece& one = all[g];
    if (one.lower.is_empty() || one.upper.is_empty()) return {};
    one.is_solid = piece.is_solid;
    measure(lower, one.lower);
    measure(upper, one.upper);
    groups.push_back(std::move(one));
  }
  if (groups.size() < 2) groups.clear();
  return groups;
}

/// Tiles of all groups; none if some meet, or if those that are moved do not come over each other.
std::optional<Replacement> tile_groups(const Region& lower, const Region& upper,
                                       std::vector<Piece> groups, bool are_moved,
                                       std::optional<double> max_shift, std::size_t most_pairs) {
  std::vector<Replacement> each;
  for (Piece& group : groups) {
    if (are_moved && group.lower.parts == 1 && group.upper.parts == 1) {
      group.shift = offset(group);
      const double way = std::hypot(group.shift.x, group.shift.y);
      if (!is_within(way, max_shift.value_or(way))) return {};
      group.reason = LinkReason::slide;
    }
    auto moved = move_by_shift(lower, upper, std::move(group), most_pairs);
    if (!moved) return {};
    if (are_moved && !is_within(least_overlap, overlap(moved->piece, moved->difference))) return {};
    each.push_back(replacement(std::move(*moved), {}));
  }
  return together(lower, upper, each);
}

}  // namespace

bool separate(const Region& lower, const Region& upper, TileSet& tiles, Pieces& pieces,
              std::span<const double> /*before*/, std::optional<double> max_shift) {
  const std::size_t most_pairs = most_pairs_of(lower.points.size() + upper.points.size());
  std::vector<Replacement> replacements;
  for (std::uint32_t i = 0; i < pieces.pieces.size(); ++i) {
    const Piece& piece = pieces.pieces[i];
    if (piece.lower.parts < 2 || piece.upper.parts < 2) continue;
    if (piece.reason != LinkReason::overlap || piece.is_tip()) continue;
    const std::vector<Piece> groups = groups_of(lower, upper, piece);
    if (groups.empty()) continue;
    auto made = tile_groups(lower, upper, groups, false, max_shift, most_pairs);
    if (!made) made = tile_groups(lower, upper, groups, true, max_shift, most_pairs);
    if (!made) continue;
    made->replaced = {i};
    replacements.push_back(std::move(*made));
  }
  return replace(lower, upper, tiles, pieces, replacements);
}

}  // namespace loft
