// SPDX-License-Identifier: MIT
#include "reconstruct/live/exchange.h"

#include <algorithm>
#include <unordered_set>
#include <utility>
#include <vector>

#include "reconstruct/sew/caps.h"
#include "reconstruct/sew/sewing.h"

namespace loft {

namespace {

class Exchange {
 public:
  Exchange(LiveStack& stack, Gaps& gaps, std::vector<Rim*> rims, SurfaceChange& change)
      : stack_(stack), gaps_(gaps), rims_(std::move(rims)), change_(change) {}

  void run() {
    for (const Gap& gap : gaps_.all())
      if (gap.before != nullptr) kept_in_part_.insert(gap.before);
    for (const double z : gaps_.gone()) let_go(stack_.slabs.find(z)->second);
    for (Gap& gap : gaps_.all()) list_units(gap);
    const bool has_lost = !removed_.empty();
    for (std::size_t i = 0; i < units_.size();) {
      std::size_t end = i;
      while (end < units_.size() && units_[end].is_new) ++end;
      if (end > i) {
        splice(i, end, i - (touches_below(i) ? 1 : 0), end + (touches_above(end - 1) ? 1 : 0));
      } else if (has_lost && is_torn(units_[i])) {
        splice(i, i, i - (touches_below(i) ? 1 : 0), i + 1 + (touches_above(i) ? 1 : 0));
      }
      i = std::max(end, i + 1);
    }
    if (!removed_.empty())
      add(stack_.surface.splice(
          {.layers = {}, .removed = std::move(removed_), .rims = std::move(rims_)}));

    for (const double z : gaps_.gone()) stack_.slabs.erase(z);
    for (Gap& gap : gaps_.all())
      if (gap.made) stack_.slabs[gap.lower->region->z] = std::move(*gap.made);
    std::ranges::sort(change_.removed);
    std::ranges::sort(change_.resewn);
    change_.resewn.erase(std::unique(change_.resewn.begin(), change_.resewn.end()),
                         change_.resewn.end());
  }

 private:
  /// A layer of the surface as it is to be, from low to high.
  struct Unit {
    Gap* gap;
    enum class Kind { bottom_cap, slab, top_cap } kind;
    bool is_new;
    Faces* faces;  // where they are kept
  };

  void let_go(const LiveSlab& slab) {
    change_.removed.push_back(slab.frozen->info.id);
    for (const double z : {slab.frozen->info.low, slab.frozen->info.high}) {
      const auto station = stack_.stations.find(z);
      if (station != stack_.stations.end()) rims_.push_back(&station->second.rim);
    }
    for (const Faces* faces : {&slab.bottom, &slab.faces, &slab.top})
      if (faces != &slab.faces || !kept_in_part_.contains(&slab))
        removed_.insert(removed_.end(), faces->begin(), faces->end());
  }

  void list_units(Gap& gap) {
    LiveSlab* const there = gap.there;
    LiveSlab& slab = gap.slab();
    if (gap.made && there != nullptr) {
      change_.removed.push_back(there->frozen->info.id);
      rims_.insert(rims_.end(), {&gap.lower->rim, &gap.upper->rim});
      for (auto faces : {&LiveSlab::bottom, &LiveSlab::faces, &LiveSlab::top}) {
        const bool is_kept = faces == &LiveSlab::faces    ? gap.keeps_tiles
                             : faces == &LiveSlab::bottom ? slab.frozen->has_bottom_cap
                                                          : slab.frozen->has_top_cap;
        if (is_kept) {
          slab.*faces = there->*faces;
        } else {
          removed_.insert(removed_.end(), (there->*faces).begin(), (there->*faces).end());
        }
      }
      if (gap.keeps_tiles) stack_.surface.set_slab(slab.faces, slab.frozen->info.id);
      stack_.surface.set_slab(slab.bottom, slab.frozen->info.id);
      stack_.surface.set_slab(slab.top, slab.frozen->info.id);
    }
    if (gap.before != nullptr) {
      for (const std::uint32_t tile : gap.kept) slab.faces.push_back(gap.before->faces[tile]);
      for (const std::uint32_t tile : gap.dropped) removed_.push_back(gap.before->faces[tile]);
      stack_.surface.set_slab(slab.faces, slab.frozen->info.id);
    }
    if (slab.frozen->has_bottom_cap)
      units_.push_back({&gap, Unit::Kind::bottom_cap, slab.bottom.empty(), &slab.bottom});
    units_.push_back({&gap, Unit::Kind::slab, gap.made && !gap.keeps_tiles, &slab.faces});
    if (slab.frozen->has_top_cap)
      units_.push_back({&gap, Unit::Kind::top_cap, slab.top.empty(), &slab.top});
  }

  [[nodiscard]] static const FrozenSlab& frozen(const Unit& unit) {
    return *unit.gap->slab().frozen;
  }

  [[nodiscard]] static Layer layer(const Unit& unit) {
    const FrozenSlab& slab = frozen(unit);
    if (unit.kind == Unit::Kind::bottom_cap) {
      Layer cap = bottom_cap(*slab.lower);
      cap.slab = slab.info.id;
      return cap;
    }
    if (unit.kind == Unit::Kind::top_cap)
      return top_cap(*slab.upper, slab.info.id, slab.lower->slice);
    Layer layer{slab.lower.get(), slab.upper.get(), {}, slab.info.id, slab.lower->slice};
    layer.tiles.inner = slab.tiles->inner;
    const bool is_partial = unit.is_new && unit.gap->before != nullptr;
    const std::size_t kept = is_partial ? unit.gap->kept.size() : 0;
    layer.tiles.tiles.assign(slab.tiles->tiles.begin() + static_cast<std::ptrdiff_t>(kept),
                             slab.tiles->tiles.end());
    return layer;
  }

  [[nodiscard]] static RimmedSlice below(const Unit& unit) {
    if (unit.kind == Unit::Kind::bottom_cap) return {};
    Station& station = unit.kind == Unit::Kind::slab ? *unit.gap->lower : *unit.gap->upper;
    return {station.region.get(), &station.rim};
  }
  [[nodiscard]] static RimmedSlice above(const Unit& unit) {
    if (unit.kind == Unit::Kind::top_cap) return {};
    Station& station = unit.kind == Unit::Kind::slab ? *unit.gap->upper : *unit.gap->lower;
    return {station.region.get(), &station.rim};
  }

  /// Whether there are places in a slice where its contours touch.
  [[nodiscard]] static bool is_touching(const RimmedSlice& slice) {
    return slice.region != nullptr && !is_simple(*slice.region);
  }
  [[nodiscard]] bool touches_below(std::size_t unit) const {
    return unit > 0 && is_touching(below(units_[unit]));
  }
  [[nodiscard]] bool touches_above(std::size_t unit) const {
    return unit + 1 < units_.size() && is_touching(above(units_[unit]));
  }

  /// Whether a slab is the end of an open surface where its contours touch: without what was beyond
  /// it the parts there are others.
  [[nodiscard]] bool is_torn(const Unit& unit) const {
    const auto needs_both_sides = [](const Station& slice) {
      return !is_simple(*slice.region) || !slice.rim.is_regular;
    };
    return stack_.options.cap == Cap::open &&
           ((unit.gap->is_first && needs_both_sides(*unit.gap->lower)) ||
            (unit.gap->is_last && needs_both_sides(*unit.gap->upper)));
  }

  /// Puts the new units from `begin` to `end` into the surface, with those from `first` to `last`,
  /// and as many beside them as have to be sewn with them: where contours of a slice touch, so may
  /// the layers below and above it.
  void splice(std::size_t begin, std::size_t end, std::size_t first, std::size_t last) {
    for (;;) {
      while (first > 0 && !below(units_[first]).rim->is_regular) --first;
      while (last < units_.size() && !above(units_[last - 1]).rim->is_regular) ++last;
      const Spliced spliced = stack_.surface.splice(make_splice(begin, end, first, last));
      if ((spliced.needs_below || spliced.needs_above) && make_whole(begin, end)) continue;
      if (spliced.needs_below) --first;
      if (spliced.needs_above) ++last;
      if (spliced.needs_below || spliced.needs_above) continue;
      for (std::size_t i = first; i < last; ++i) {
        Faces& faces = *units_[i].faces;
        Gap& gap = *units_[i].gap;
        const bool stays = !units_[i].is_new && !gap.made;
        if (stays && faces != spliced.faces[i - first])
          change_.resewn.push_back(gap.there->frozen->info.id);
        if (units_[i].gap->before == nullptr || !units_[i].is_new) faces.clear();
        faces.insert(faces.end(), spliced.faces[i - first].begin(), spliced.faces[i - first].end());
        gap.slab().is_sewn_as_tiled = spliced.is_sewn_as_tiled;
        units_[i].is_new = false;
      }
      add(spliced);
      removed_.clear();
      rims_.clear();
      return;
    }
  }

  /// Gives up that slabs keep some of their tiles. Whether any did.
  bool make_whole(std::size_t begin, std::size_t end) {
    bool has_any = false;
    for (std::size_t i = begin; i < end; ++i) {
      Gap& gap = *units_[i].gap;
      if (gap.before == nullptr) continue;
      removed_.insert(removed_.end(), units_[i].faces->begin(), units_[i].faces->end());
      units_[i].faces->clear();
      gap.before = nullptr;
      has_any = true;
    }
    return has_any;
  }

  [[nodiscard]] Splice make_splice(std::size_t begin, std::size_t end, std::size_t first,
                                   std::size_t last) const {
    Splice splice;
    const std::size_t context_begin = first - (touches_below(first) ? 1 : 0);
    const std::size_t context_end = last + (touches_above(last - 1) ? 1 : 0);
    for (std::size_t i = context_begin; i < context_end; ++i)
      splice.layers.push_back(layer(units_[i]));
    splice.first = first - context_begin;
    splice.last = last - context_begin;
    splice.is_partial =
        std::any_of(units_.begin() + static_cast<std::ptrdiff_t>(first),
                    units_.begin() + static_cast<std::ptrdiff_t>(last),
                    [](const Unit& unit) { return unit.is_new && unit.gap->before != nullptr; });
    splice.has_below = first > 0;
    splice.has_above = last < units_.size();
    splice.removed = removed_;
    splice.rims = rims_;
    for (std::size_t i = first; i < last; ++i) {
      splice.slices.push_back(below(units_[i]));
      const Faces* present = i < begin || i >= end ? units_[i].faces : nullptr;
      splice.present.push_back(present);
      if (present != nullptr)
        splice.removed.insert(splice.removed.end(), present->begin(), present->end());
    }
    splice.slices.push_back(above(units_[last - 1]));
    return splice;
  }

  void add(const Spliced& spliced) {
    change_.vertices_added += spliced.vertices_added;
    change_.vertices_removed += spliced.vertices_removed;
    change_.faces_added += spliced.faces_added;
    change_.faces_removed += spliced.faces_removed;
    if (!spliced.bounds) return;
    change_.bounds = change_.bounds ? joined(*change_.bounds, *spliced.bounds) : *spliced.bounds;
  }

  LiveStack& stack_;
  Gaps& gaps_;
  std::vector<Rim*> rims_;  // of the slices at the faces that go
  std::unordered_set<const LiveSlab*> kept_in_part_;
  std::vector<Unit> units_;
  Faces removed_;
  SurfaceChange& change_;
};

}  // namespace

void exchange(LiveStack& stack, Gaps& gaps, std::vector<Rim*> rims, SurfaceChange& change) {
  Exchange(stack, gaps, std::move(rims), change).run();
}

}  // namespace loft
