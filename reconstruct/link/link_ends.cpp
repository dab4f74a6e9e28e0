// SPDX-License-Identifier: MIT
#include "reconstruct/link/link_ends.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "reconstruct/link/bounds.h"
#include "reconstruct/link/moves.h"
#include "reconstruct/link/replace.h"

namespace loft {

namespace {

/// Joining ends to what goes on beside them leaves no more of all their differences than that.
constexpr double most_of_joined = 0.9;
/// Where ends lie beside others, they must take away at least that share of the smaller areas; all
/// of it, if half of these come to lie over each other.
constexpr double least_of_beside = 0.5;
constexpr double shorter_way = 0.7;

/// The outer loops of a footprint, or the holes in it.
Footprint loops(const Region& region, const Footprint& whole, bool is_solid, bool is_outer) {
  Footprint chosen;
  for (const std::uint32_t loop : whole.loops) {
    Footprint one;
    one.loops = {loop};
    if ((measure(region, one) == is_solid) == is_outer) chosen.loops.push_back(loop);
  }
  if (!chosen.is_empty()) measure(region, chosen);
  return chosen;
}

/// A hollow part beside a solid or a narrower one, as where a shell closes: its outlines are joined
/// and its holes by themselves, or they end. None if these tiles meet.
std::optional<Replacement> move_shell(const Region& lower, const Region& upper,
                                      const Piece& whole) {
  Piece outside = whole;
  outside.lower = loops(lower, whole.lower, whole.is_solid, true);
  outside.upper = loops(upper, whole.upper, whole.is_solid, true);
  Piece inside = whole;
  inside.is_solid = !whole.is_solid;
  inside.lower = loops(lower, whole.lower, whole.is_solid, false);
  inside.upper = loops(upper, whole.upper, whole.is_solid, false);
  if (inside.lower.is_empty() && inside.upper.is_empty()) return std::nullopt;
  outside.shift = inside.shift = offset(outside);
  auto outer = move_by_shift(lower, upper, std::move(outside));
  auto inner = move_by_shift(lower, upper, std::move(inside));
  if (!outer || !inner || !is_within(least_overlap, overlap(outer->piece, outer->difference)))
    return std::nullopt;
  std::vector<Replacement> both;
  both.push_back(replacement(std::move(*outer), {}));
  both.push_back(replacement(std::move(*inner), {}));
  return together(lower, upper, both);
}

/// The pieces that links join, directly or not: those of one with the same number, that of the
/// first of them.
std::vector<std::uint32_t> groups(std::size_t count, std::span<const EndLink> links) {
  std::vector<std::uint32_t> group(count);
  std::iota(group.begin(), group.end(), 0U);
  const auto first = [&](std::uint32_t i) {
    while (group[i] != i) i = group[i];
    return i;
  };
  for (const EndLink& link : links) {
    const std::uint32_t a = first(link.lower);
    const std::uint32_t b = first(link.upper);
    group[std::max(a, b)] = std::min(a, b);
  }
  for (std::uint32_t i = 0; i < count; ++i) group[i] = group[group[i]];
  return group;
}

void add(Footprint& sum, const Footprint& more) {
  sum.loops.insert(sum.loops.end(), more.loops.begin(), more.loops.end());
}

/// Towards what their links join them to: the ways of the loops of some pieces' footprints.
std::vector<cdt::Point> ways_of_ends(const Pieces& pieces, std::span<const EndLink> links,
                                     Level level, std::span<const std::uint32_t> loops) {
  std::vector<cdt::Point> ways(loops.size());
  for (const EndLink& link : links) {
    const bool is_lower = level == Level::lower;
    const Piece& own = pieces.pieces[is_lower ? link.lower : link.upper];
    const Piece& joined = pieces.pieces[is_lower ? link.upper : link.lower];
    const auto& beside = is_lower ? link.lower_way : link.upper_way;
    if (!own.is_end() || (link.is_beside() && !beside)) continue;
    const cdt::Point from = own.footprint(level).centroid;
    const cdt::Point to = joined.footprint(other(level)).centroid;
    for (const std::uint32_t loop : own.footprint(level).loops) {
      const auto place = std::ranges::find(loops, loop);
      if (place != loops.end())
        ways[static_cast<std::size_t>(place - loops.begin())] =
            beside.value_or(cdt::Point{to.x - from.x, to.y - from.y});
    }
  }
  return ways;
}

/// Whether all outlines are joined by one surface. Those of other pieces have no tiles.
bool is_one(const Region& lower, const Region& upper, const Moved& moved) {
  const Pieces pieces = find_pieces(lower, upper, moved.tiles);
  std::vector<bool> has_tiles(pieces.pieces.size());
  for (const std::uint32_t piece : pieces.of_tile) has_tiles[piece] = true;
  std::size_t count = 0;
  for (std::size_t i = 0; i < has_tiles.size(); ++i)
    if (has_tiles[i] && pieces.pieces[i].is_solid == moved.piece.is_solid) ++count;
  return count == 1;
}

/// What links leave of the differences of what they join, at most.
double most_difference(const Pieces& pieces, std::span<const EndLink> links, double before) {
  double beside = 0;
  for (const EndLink& link : links)
    if (link.is_beside())
      beside +=
          std::min(pieces.pieces[link.lower].lower.area, pieces.pieces[link.upper].upper.area);
  return beside > 0 ? before - least_of_beside * beside : most_of_joined * before;
}

/// Where what an end comes to lie over has no room for it.
LoopWays shortened(LoopWays ways) {
  for (auto* const some : {&ways.lower, &ways.upper})
    for (cdt::Point& way : *some) way = {shorter_way * way.x, shorter_way * way.y};
  return ways;
}

/// Some pieces as one that is not tiled yet.
Piece united(const Region& lower, const Region& upper, const Pieces& pieces,
             std::span<const std::uint32_t> members) {
  Piece whole;
  whole.is_solid = pieces.pieces[members.front()].is_solid;
  for (const std::uint32_t i : members) {
    add(whole.lower, pieces.pieces[i].lower);
    add(whole.upper, pieces.pieces[i].upper);
  }
  std::ranges::sort(whole.lower.loops);
  std::ranges::sort(whole.upper.loops);
  measure(lower, whole.lower);
  measure(upper, whole.upper);
  return whole;
}

/// A piece from the ways of its ends, or from shorter ones, with no more of a difference than that.
std::optional<Moved> move_ends(const Region& lower, const Region& upper, const Piece& whole,
                               const LoopWays& ways, bool are_beside, double most) {
  const auto is_wanted = [&](const Registered& made) { return is_within(made.difference, most); };
  const auto move_as_one = [&](const LoopWays& some) {
    auto made = move_by_places(lower, upper, whole, is_wanted, some);
    if (made && is_one(lower, upper, *made)) return made;
    made.reset();
    if (are_beside) made = move_by_ways(lower, upper, whole, is_wanted, some);
    if (made && !is_one(lower, upper, *made)) made.reset();
    return made;
  };
  auto moved = move_as_one(ways);
  if (!moved && are_beside) moved = move_as_one(shortened(ways));
  return moved;
}

/// How much more of a difference some pieces have where they are than where they were moved to;
/// infinite if that cannot be measured.
double taken_away(const Region& lower, const Region& upper, const Pieces& pieces,
                  std::span<const std::uint32_t> members) {
  double sum = 0;
  for (const std::uint32_t i : members) {
    const Piece& piece = pieces.pieces[i];
    if (piece.registered_difference && !piece.is_end())
      sum += overlay_difference(lower, upper, piece) - *piece.registered_difference;
  }
  return sum;
}

/// Ends, and what goes on beside them, as one piece. None if no more than they are by themselves.
/// What was moved before, without the ends, may lie where these belong: as a fork of which one
/// branch overlaps the other's root. If no joint piece is as good, it is held against that as it
/// was.
std::optional<Replacement> join(const Region& lower, const Region& upper, const Pieces& pieces,
                                std::span<const EndLink> links, std::span<const double> differences,
                                std::span<const std::uint32_t> members) {
  const Piece whole = united(lower, upper, pieces, members);
  double before = 0;
  for (const std::uint32_t i : members) before += differences[i];
  const LoopWays ways{ways_of_ends(pieces, links, Level::lower, whole.lower.loops),
                      ways_of_ends(pieces, links, Level::upper, whole.upper.loops)};
  const bool are_beside = std::ranges::any_of(links, &EndLink::is_beside);
  const auto move = [&](double difference) {
    return move_ends(lower, upper, whole, ways, are_beside,
                     most_difference(pieces, links, difference));
  };
  auto moved = move(before);
  if (!moved) {
    const double more = taken_away(lower, upper, pieces, members);
    if (more > 0 && std::isfinite(more)) moved = move(before + more);
  }
  if (!moved) return {};
  moved->piece.reason = are_beside ? LinkReason::nearest : LinkReason::predicted;
  moved->piece.bends = true;
  return replacement(std::move(*moved), {members.begin(), members.end()});
}

/// Two ends as one piece.
std::optional<Replacement> link_two(const Region& lower, const Region& upper, const Pieces& pieces,
                                    const EndLink& link) {
  Piece piece;
  piece.is_solid = pieces.pieces[link.lower].is_solid;
  piece.lower = pieces.pieces[link.lower].lower;
  piece.upper = pieces.pieces[link.upper].upper;
  piece.reason = link.reason;
  piece.shift = offset(piece);
  auto moved = move_by_shift(lower, upper, piece);
  const std::vector<std::uint32_t> both{link.lower, link.upper};
  const auto is_wanted = [&](const Registered& made) {
    return is_within(least_overlap, overlap(piece, made.difference));
  };
  if (moved && is_within(least_overlap, overlap(piece, moved->difference)))
    return replacement(std::move(*moved), both);
  if (auto shell = move_shell(lower, upper, piece)) {
    shell->replaced = both;
    return shell;
  }
  if (auto fitted = move_by_loops(lower, upper, piece, is_wanted))
    return replacement(std::move(*fitted), both);
  if (moved && link.reason == LinkReason::order) return replacement(std::move(*moved), both);
  return {};
}

/// Links that lead to no joint piece.
using Unmet = std::vector<EndLink>;

/// Joins what links join directly or not, but for pairs of ends that do not lie beside each other.
Unmet join_groups(const Region& lower, const Region& upper, const Pieces& pieces,
                  std::span<const EndLink> links, std::span<const double> differences,
                  std::vector<Replacement>& replacements) {
  const std::vector<std::uint32_t> group = groups(pieces.pieces.size(), links);
  std::vector<std::vector<std::uint32_t>> members(group.size());
  std::vector<std::vector<EndLink>> links_of(group.size());
  for (const EndLink& link : links) links_of[group[link.lower]].push_back(link);
  for (std::uint32_t i = 0; i < group.size(); ++i) members[group[i]].push_back(i);
  Unmet unmet;
  for (std::uint32_t i = 0; i < group.size(); ++i) {
    if (links_of[i].empty()) continue;
    const EndLink& first = links_of[i].front();
    const bool is_pair = members[i].size() == 2 && pieces.pieces[first.lower].is_end() &&
                         pieces.pieces[first.upper].is_end() && !first.is_beside();
    std::optional<Replacement> joined;
    if (!is_pair) joined = join(lower, upper, pieces, links_of[i], differences, members[i]);
    if (joined)
      replacements.push_back(std::move(*joined));
    else
      unmet.insert(unmet.end(), links_of[i].begin(), links_of[i].end());
  }
  return unmet;
}

}  // namespace

void link_ends(const Region& lower, const Region& upper, TileSet& tiles, Pieces& pieces,
               std::span<const EndLink> links) {
  if (links.empty()) return;
  std::vector<Replacement> replacements;
  const std::vector<double> before = differences(lower, upper, tiles, pieces);
  Unmet left = join_groups(lower, upper, pieces, links, before, replacements);
  if (std::erase_if(left, [](const EndLink& link) { return link.is_beside(); }) != 0)
    left = join_groups(lower, upper, pieces, left, before, replacements);
  for (const EndLink& link : left) {
    if (!pieces.pieces[link.lower].is_end() || !pieces.pieces[link.upper].is_end()) continue;
    if (auto linked = link_two(lower, upper, pieces, link))
      replacements.push_back(std::move(*linked));
  }
  replace(lower, upper, tiles, pieces, replacements);
}

}  // namespace loft
