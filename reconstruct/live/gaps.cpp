// SPDX-License-Identifier: MIT
#include "reconstruct/live/gaps.h"

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "reconstruct/link/lean.h"
#include "reconstruct/link/link_ends.h"
#include "reconstruct/link/link_orders.h"
#include "reconstruct/live/retile.h"
#include "reconstruct/shape/forks.h"
#include "reconstruct/shape/refine.h"

namespace loft {

Gaps::Gaps(LiveStack& stack, std::vector<Station*> line, bool is_bottom, bool is_top)
    : stack_(stack), line_(std::move(line)) {
  for (std::size_t i = 0; i + 1 < line_.size(); ++i)
    gaps_.push_back({line_[i], line_[i + 1], is_bottom && i == 0, is_top && i + 2 == line_.size()});
  find_present(is_bottom, is_top);
}

void Gaps::make() {
  for (Gap& gap : gaps_) tile(gap);
  for (std::size_t i = 0; i < gaps_.size(); ++i) link(i);
  for (std::size_t i = 0; i < gaps_.size(); ++i) bend(i);
  for (Gap& gap : gaps_) freeze(gap);
}

const std::vector<std::uint32_t>* Gaps::matches(double z) const {
  const auto found = matches_.find(z);
  return found == matches_.end() ? nullptr : &found->second;
}

void Gaps::find_present(bool is_bottom, bool is_top) {
  if (line_.empty()) {
    for (const auto& [z, slab] : stack_.slabs) gone_.push_back(z);
    return;
  }
  const double low = line_.front()->region->z;
  const double high = line_.back()->region->z;
  auto slab = is_bottom ? stack_.slabs.begin() : stack_.slabs.lower_bound(low);
  for (; slab != stack_.slabs.end() && (is_top || slab->first < high); ++slab) {
    auto& [z, there] = *slab;
    const auto gap =
        std::ranges::lower_bound(gaps_, z, {}, [](const Gap& one) { return one.lower->region->z; });
    if (gap == gaps_.end() || gap->lower->region != there.frozen->lower ||
        gap->upper->region != there.frozen->upper) {
      gone_.push_back(z);
    } else {
      gap->there = &there;
    }
  }
}

void Gaps::tile(Gap& gap) {
  if (gap.there != nullptr) return;
  gap.made.emplace();
  if (!tile_in_part(gap)) tile_by_overlap(gap);
  gap.made->found = std::make_shared<const Pieces>(*gap.pieces);
}

/// Where the slab was there, but for some loops of one of its slices.
bool Gaps::tile_in_part(Gap& gap) {
  const Options& options = stack_.options;
  if (options.smooth || options.max_edge || options.target_edge || gap.is_first || gap.is_last)
    return false;
  const auto found = stack_.slabs.find(gap.lower->region->z);
  if (found == stack_.slabs.end()) return false;
  LiveSlab& before = found->second;
  const FrozenSlab& old = *before.frozen;
  const bool is_lower_same = old.lower == gap.lower->region;
  if (old.info.high != gap.upper->region->z || !before.is_sewn_as_tiled ||
      !before.ends.links.empty() || old.has_bottom_cap || old.has_top_cap ||
      is_lower_same == (old.upper == gap.upper->region))
    return false;
  const Station& changed = is_lower_same ? *gap.upper : *gap.lower;
  const auto& matches = match(changed, is_lower_same ? *old.upper : *old.lower);
  auto retiled = retile({*old.lower, *old.upper, *old.linked, *old.pieces, *gap.lower->region,
                         *gap.upper->region, is_lower_same ? Level::upper : Level::lower, matches},
                        options, stack_.workspace);
  if (!retiled) return false;
  gap.before = &before;
  gap.kept = std::move(retiled->kept);
  gap.dropped = std::move(retiled->gone);
  gap.tiles = std::move(retiled->tiles);
  gap.pieces = std::move(retiled->pieces);
  return true;
}

/// The loops of a slice that it had before. Its edges there stay, as long as a face is at them.
const std::vector<std::uint32_t>& Gaps::match(const Station& station, const Region& old) {
  const auto [found, is_new] = matches_.try_emplace(station.region->z);
  if (is_new) found->second = match_loops(*station.region, old);
  return found->second;
}

void Gaps::tile_by_overlap(Gap& gap) {
  gap.before = nullptr;
  OrderedTiles tiled =
      tile_by_orders(*gap.lower->region, *gap.upper->region, stack_.options, {}, stack_.workspace);
  gap.tiles = std::move(tiled.tiles);
  gap.pieces = std::move(tiled.pieces);
}

/// Whether all that a slab looks at is known: its neighbours, if it has any.
bool Gaps::has_neighbours(std::size_t i) const {
  return (i > 0 || gaps_[i].is_first) && (i + 1 < gaps_.size() || gaps_[i].is_last);
}

SlabPieces Gaps::view(std::size_t i) const {
  if (i >= gaps_.size()) return {};
  return {gaps_[i].slab().found.get(), gaps_[i].height(), gaps_[i].lower->region.get(),
          gaps_[i].upper->region.get()};
}

namespace {

/// Whether there are ends to lean of which a slab keeps the tiles as they were.
bool keeps_any(const Gap& gap, std::span<const EndLean> leans) {
  std::vector<bool> is_kept(gap.pieces->pieces.size());
  for (std::size_t t = 0; t < gap.kept.size(); ++t) is_kept[gap.pieces->of_tile[t]] = true;
  std::array<std::vector<bool>, 2> is_kept_loop;  // by level
  is_kept_loop[0].resize(gap.lower->region->loop_count());
  is_kept_loop[1].resize(gap.upper->region->loop_count());
  for (std::size_t p = 0; p < is_kept.size(); ++p)
    for (const Level level : {Level::lower, Level::upper})
      for (const std::uint32_t loop : gap.pieces->pieces[p].footprint(level).loops)
        is_kept_loop[static_cast<std::size_t>(level)][loop] = is_kept[p];
  return std::ranges::any_of(leans, [&](const EndLean& lean) {
    return is_kept_loop[static_cast<std::size_t>(lean.level)][lean.loop];
  });
}

}  // namespace

void Gaps::link(std::size_t i) {
  Gap& gap = gaps_[i];
  if (!has_neighbours(i)) return;
  EndPlan ends;
  if (stack_.options.link == LinkRule::automatic)
    ends = match_ends(i == 0 ? SlabPieces() : view(i - 1), view(i), view(i + 1),
                      stack_.options.max_shift, {});
  if (gap.there != nullptr) {
    if (ends == gap.there->ends) return;
    gap.made.emplace();
    gap.made->found = gap.there->found;
    tile_by_overlap(gap);
  } else if (gap.before != nullptr && (!ends.links.empty() || keeps_any(gap, ends.leans))) {
    tile_by_overlap(gap);  // the pieces are the same, and in the same order
  }
  link_ends(*gap.lower->region, *gap.upper->region, *gap.tiles, *gap.pieces, ends.links);
  lean_ends(*gap.lower->region, *gap.upper->region, *gap.tiles, *gap.pieces, ends.leans);
  gap.made->ends = std::move(ends);
}

/// Of the slices that a slab is bent by.
Gaps::Shapes Gaps::shapes_around(std::size_t i) {
  Shapes shapes;
  for (std::size_t k = 0; k < shapes.size(); ++k) {
    if (i + k < 1 || i + k - 1 >= line_.size()) continue;
    auto& shape = line_[i + k - 1]->shape;
    if (shape == nullptr) shape = std::make_shared<const SliceShape>(*line_[i + k - 1]->region);
    shapes[k] = shape;
  }
  return shapes;
}

/// Brings the tiles of a slab into their final shape.
void Gaps::bend(std::size_t i) {
  Gap& gap = gaps_[i];
  const Options& options = stack_.options;
  if (!gap.made) {
    if (!gap.there->is_bent() || !has_neighbours(i) || shapes_around(i) == gap.there->shapes)
      return;
    gap.made.emplace();
    gap.made->found = gap.there->found;
    gap.made->ends = gap.there->ends;
  }
  const bool is_tiled = gap.tiles.has_value();
  auto linked =
      is_tiled ? std::make_shared<const TileSet>(std::move(*gap.tiles)) : gap.there->frozen->linked;
  auto pieces =
      is_tiled ? std::make_shared<const Pieces>(std::move(*gap.pieces)) : gap.there->frozen->pieces;
  if (is_tiled && gap.made->ends.is_empty()) pieces = gap.made->found;  // the same
  auto tiles = linked;
  const Region& lower = *gap.lower->region;
  const Region& upper = *gap.upper->region;
  std::vector<bool> at_forks;  // if these alone are bent
  if (!options.smooth) at_forks = tiles_at_forks(lower, upper, *pieces, *linked);
  if (options.smooth || !at_forks.empty()) {
    gap.made->shapes = shapes_around(i);
    Surroundings around{};
    for (std::size_t k = 0; k < around.size(); ++k) around[k] = gap.made->shapes[k].get();
    tiles = std::make_shared<const TileSet>(
        options.smooth ? smooth(lower, upper, around, *pieces, *linked, options.smooth_tolerance)
                       : bend_forks(lower, upper, around, *pieces, *linked, at_forks));
  }
  if (gap.before != nullptr) keep_unbent(gap, linked->tiles.size(), at_forks);
  if (options.max_edge || options.target_edge)
    tiles = std::make_shared<const TileSet>(refine(lower, upper, *tiles, options));
  FrozenSlab frozen{{0, lower.z, upper.z}, gap.lower->region, gap.upper->region};
  frozen.volume = loft::volume(lower, upper, *tiles);
  frozen.tiles = std::move(tiles);
  frozen.linked = std::move(linked);
  frozen.at_forks = std::move(at_forks);
  frozen.pieces = std::move(pieces);
  gap.made->frozen = std::make_shared<const FrozenSlab>(std::move(frozen));
}

/// A slab that keeps some of its tiles keeps those at forks no longer: they may be bent otherwise.
/// The others come first in it, in their order, before and now.
void Gaps::keep_unbent(Gap& gap, std::size_t tile_count, std::vector<bool> bent) {
  const FrozenSlab& old = *gap.before->frozen;
  std::vector<bool> old_bent = old.at_forks;
  if (bent.empty() && old_bent.empty()) return;
  bent.resize(tile_count);
  old_bent.resize(old.linked->tiles.size());
  std::vector<std::uint32_t> places;  // of old tiles, as they were bent
  for (std::uint32_t bound = 0; const bool is_bent : old_bent)
    places.push_back(is_bent ? Origin::none : bound++);
  std::vector<std::uint32_t> kept;
  for (std::size_t t = 0; t < gap.kept.size(); ++t) {
    if (bent[t]) continue;
    if (old_bent[gap.kept[t]]) {  // by a fork that touched it
      gap.before = nullptr;
      return;
    }
    kept.push_back(places[gap.kept[t]]);
  }
  std::vector<bool> is_kept(old.tiles->tiles.size());
  for (const std::uint32_t tile : kept) is_kept[tile] = true;
  gap.kept = std::move(kept);
  gap.dropped.clear();
  for (std::uint32_t t = 0; t < is_kept.size(); ++t)
    if (!is_kept[t]) gap.dropped.push_back(t);
}

/// Gives a slab that is new or changed its number.
void Gaps::freeze(Gap& gap) {
  const bool is_capped = stack_.options.cap == Cap::flat;
  const bool has_bottom = is_capped && gap.is_first && gap.lower->region->has_loops();
  const bool has_top = is_capped && gap.is_last && gap.upper->region->has_loops();
  if (!gap.made) {
    const FrozenSlab& there = *gap.there->frozen;
    if (there.has_bottom_cap == has_bottom && there.has_top_cap == has_top) return;
    gap.keeps_tiles = true;
    gap.made.emplace();
    gap.made->frozen = gap.there->frozen;
    gap.made->found = gap.there->found;
    gap.made->ends = gap.there->ends;
    gap.made->shapes = gap.there->shapes;
    gap.made->is_sewn_as_tiled = gap.there->is_sewn_as_tiled;
  }
  auto frozen = std::make_shared<FrozenSlab>(*gap.made->frozen);
  frozen->info.id = stack_.next_id++;
  frozen->has_bottom_cap = has_bottom;
  frozen->has_top_cap = has_top;
  gap.made->frozen = std::move(frozen);
}

}  // namespace loft
