// SPDX-License-Identifier: MIT
#include "reconstruct/live/stack_edit.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <memory>
#include <span>
#include <utility>

#include "reconstruct/clean/cleaning.h"
#include "reconstruct/clean/heights.h"
#include "reconstruct/clean/lines.h"
#include "reconstruct/link/tips.h"
#include "reconstruct/live/exchange.h"
#include "reconstruct/live/gaps.h"
#include "reconstruct/number_text.h"
#include "reconstruct/usable.h"

namespace loft {

namespace {

Defect merged_slices(double z, std::uint32_t slice) {
  return {DefectKind::merged_slices,
          z,
          slice,
          {},
          {},
          {},
          0,
          "came at a height where there was a slice already; merged with it"};
}

/// One edit on its way: what it makes is made first, then taken over.
class StackEdit {
 public:
  StackEdit(LiveStack& stack, std::vector<SliceEdit> edits)
      : stack_(stack),
        edits_(std::move(edits)),
        old_below_(stack.below),
        old_above_(stack.above),
        old_next_number_(stack.next_number),
        old_next_id_(stack.next_id) {}

  SurfaceChange run() {
    std::optional<Gaps> gaps;
    try {
      prepare();
      exchange_slices();
      if (!is_quiet_) {
        gaps.emplace(list_gaps());
        gaps->make();
        check_room(*gaps);
        report(*gaps);
      }
    } catch (...) {
      take_back();
      throw;
    }
    if (gaps) {
      exchange(stack_, *gaps, keep_rims(*gaps), change_);
      stack_.ends = ends_;
    }
    return std::move(change_);
  }

 private:
  void check_room(Gaps& gaps) const {
    std::size_t faces = 0;
    for (const Gap& gap : gaps.all()) {
      const FrozenSlab& slab = *gap.slab().frozen;
      faces += slab.tiles->tiles.size() + slab.lower->points.size() + slab.upper->points.size();
    }
    if (!stack_.surface.has_room_for(faces))
      throw Error("more triangles than one mesh can number; cut the stack into parts");
  }

  void report(Gaps& gaps) {
    for (const Gap& gap : gaps.all()) {
      if (!gap.made) continue;
      const FrozenSlab& slab = *gap.made->frozen;
      change_.added.push_back(slab.info);
      const bool is_interrupted =
          !gap.is_first && gap.lower->slice != nullptr && slab.lower->is_empty();
      if (is_interrupted) change_.repairs.push_back(empty_slice(*slab.lower));
      if (!slab.linked->is_linked) change_.repairs.push_back(unlinked_slices(*slab.lower));
    }
    report_lines(gaps.all());
  }

  /// The points and lines at the slabs added that no part ends in.
  void report_lines(std::span<const Gap> gaps) {
    const auto note = [&](const Gap* below, const Gap* above) {
      const bool is_new = (below != nullptr && below->made) || (above != nullptr && above->made);
      if (!is_new) return;
      const auto pieces = [](const Gap* gap) {
        return gap == nullptr ? nullptr : gap->slab().frozen->pieces.get();
      };
      const Region& region = below != nullptr ? *below->upper->region : *above->lower->region;
      for (const std::uint32_t line : unused_lines(region, pieces(below), pieces(above)))
        change_.repairs.push_back(unused_line(region, line));
    };
    for (std::size_t i = 0; i < gaps.size(); ++i) {
      if (i > 0 || gaps[i].is_first) note(i > 0 ? &gaps[i - 1] : nullptr, &gaps[i]);
      if (i + 1 == gaps.size() && gaps[i].is_last) note(&gaps[i], nullptr);
    }
  }

  // --- Slices ---

  void prepare() {
    std::vector<Defect> fatal;
    for (const SliceEdit& edit : edits_) {
      if (!edit.slice) continue;
      std::ranges::move(find_unusable(*edit.slice, number(edit.z), stack_.options.label),
                        std::back_inserter(fatal));
      check_gap(edit.z, fatal);
    }
    if (!fatal.empty()) throw InputError(std::move(fatal));
    check_label();
    for (SliceEdit& edit : edits_) {
      if (edit.slice) {
        stations_.push_back(make_station(std::move(edit)));
      } else {
        is_quiet_ = false;
        stations_.emplace_back();
      }
    }
  }

  /// All contours have one label: those that stay say which.
  void check_label() const {
    OneLabel one_label(stack_.options.label);
    const auto stays = [&](const auto& at) {
      return !at.second.slice->contours.empty() &&
             std::ranges::find(edits_, at.first, &SliceEdit::z) == edits_.end();
    };
    const auto first = std::ranges::find_if(stack_.stations, stays);
    if (first != stack_.stations.end()) one_label.add(*first->second.slice);
    for (const SliceEdit& edit : edits_)
      if (edit.slice) one_label.add(*edit.slice);
  }

  /// Of the slice at a height, or of the next one that comes.
  [[nodiscard]] std::uint32_t number(double z) const {
    const auto there = std::isnan(z) ? stack_.stations.end() : stack_.stations.find(z);
    return there == stack_.stations.end() ? stack_.next_number : there->second.number;
  }

  [[nodiscard]] bool goes(double z) const {
    return std::ranges::any_of(edits_,
                               [&](const SliceEdit& edit) { return edit.z == z && !edit.slice; });
  }

  void check_gap(double z, std::vector<Defect>& fatal) const {
    const auto note = [&](double other) {
      fatal.push_back({DefectKind::slices_too_near,
                       z,
                       number(z),
                       {},
                       {},
                       {},
                       0,
                       "is nearer to the slice at z = " + exact(other) +
                           " than rounding allows at that height; give heights from an origin "
                           "nearby, or replace that slice"});
    };
    const auto above = stack_.stations.upper_bound(z);
    if (above != stack_.stations.end() && are_too_near(z, above->first) && !goes(above->first))
      note(above->first);
    const auto at = stack_.stations.lower_bound(z);
    if (at == stack_.stations.begin()) return;
    const double below = std::prev(at)->first;
    if (are_too_near(below, z) && !goes(below)) note(below);
  }

  [[nodiscard]] Station make_station(SliceEdit edit) {
    Station station;
    station.slice = std::move(edit.slice);
    const auto there = stack_.stations.find(edit.z);
    const bool is_known = there != stack_.stations.end();
    station.number = is_known ? there->second.number : stack_.next_number;
    if (edit.is_merged) station.repairs.push_back(merged_slices(edit.z, station.number));
    const Slice* part = station.slice.get();
    station.region =
        std::make_shared<const Region>(clean(Height{edit.z, {station.number}}, std::span(&part, 1),
                                             stack_.options, station.repairs, stack_.memory));
    std::ranges::copy(station.repairs, std::back_inserter(change_.repairs));
    if (is_known && is_same_in_slice(*there->second.region, *station.region)) {
      station.region = there->second.region;
      station.shape = there->second.shape;
      station.rim = there->second.rim;
      return station;
    }
    is_quiet_ = false;
    if (!is_known) ++stack_.next_number;
    add_shape(station);
    station.rim.edges.resize(station.region->loop_vertices.size());
    return station;
  }

  void add_shape(Station& station) const {
    if (stack_.options.smooth) station.shape = std::make_shared<const SliceShape>(*station.region);
  }

  void exchange_slices() {
    old_.reserve(edits_.size());
    for (std::size_t i = 0; i < edits_.size(); ++i) {
      const double z = edits_[i].z;
      old_.push_back(stack_.stations.extract(z));
      if (stations_[i].slice != nullptr) stack_.stations.emplace(z, std::move(stations_[i]));
    }
  }

  void take_back() {
    for (std::size_t i = 0; i < old_.size(); ++i) stack_.stations.erase(edits_[i].z);
    for (auto& node : old_)
      if (!node.empty()) stack_.stations.insert(std::move(node));
    stack_.below = std::move(old_below_);
    stack_.above = std::move(old_above_);
    stack_.next_number = old_next_number_;
    stack_.next_id = old_next_id_;
  }

  // --- Their surroundings ---

  /// The slabs near the edit; those that are there and are not among them go.
  Gaps list_gaps() {
    const auto range = stack_.range();
    if (!range) return {stack_, {}, true, true};
    auto [first, last] = *range;
    double low = edits_.front().z;
    double high = low;
    const auto widen = [&](double z) {
      low = std::min(low, z);
      high = std::max(high, z);
    };
    for (const SliceEdit& edit : edits_) widen(edit.z);
    if (stack_.ends) {
      const auto widen_if_moved = [&](double before, double now) {
        if (before == now) return;
        widen(before);
        widen(now);
      };
      widen_if_moved(stack_.ends->first, first->first);
      widen_if_moved(stack_.ends->second, last->first);
    } else {
      widen(first->first);
      widen(last->first);
    }
    ends_ = {first->first, last->first};

    constexpr int reach = 6;  // slices on either side that may matter
    auto from = stack_.stations.lower_bound(std::clamp(low, first->first, last->first));
    const auto is_irregular = [](const auto& at) { return !at->second.rim.is_regular; };
    for (int i = 0; (i < reach || is_irregular(from)) && from != first; ++i) --from;
    auto to = stack_.stations.upper_bound(std::clamp(high, first->first, last->first));
    if (to != stack_.stations.begin()) --to;
    for (int i = 0; (i < reach || is_irregular(to)) && to != last; ++i) ++to;
    const bool is_bottom = from == first;
    const bool is_top = to == last;

    const bool is_dome = stack_.options.cap == Cap::dome;
    if (is_dome) round_off(first, last);
    std::vector<Station*> line;
    if (is_dome && is_bottom && first->second.region->has_loops()) line.push_back(&stack_.below);
    for (auto station = from;; ++station) {
      line.push_back(&station->second);
      if (station == to) break;
    }
    if (is_dome && is_top && last->second.region->has_loops()) line.push_back(&stack_.above);
    return {stack_, std::move(line), is_bottom, is_top};
  }

  /// What is beyond the ends, for domes.
  void round_off(Stations::iterator first, Stations::iterator last) {
    const auto update = [&](Station& station, const Region& end, const Region& before) {
      Region region = beyond(end, before);
      if (station.region != nullptr && station.region->z == region.z) return;
      station = {};
      station.region = std::make_shared<const Region>(std::move(region));
      add_shape(station);
    };
    update(stack_.below, *first->second.region, *std::next(first)->second.region);
    update(stack_.above, *last->second.region, *std::prev(last)->second.region);
  }

  /// The edges of contours that a new slice has from the one before, as far as faces stay there.
  [[nodiscard]] std::vector<Rim*> keep_rims(const Gaps& gaps) {
    std::vector<Rim*> rims;
    for (std::size_t i = 0; i < edits_.size(); ++i) {
      const auto* matches = gaps.matches(edits_[i].z);
      if (matches == nullptr || old_[i].empty()) continue;
      const Station& old = old_[i].mapped();
      Station& now = stack_.stations.find(edits_[i].z)->second;
      for (std::uint32_t l = 0; l < matches->size(); ++l) {
        if ((*matches)[l] == Origin::none) continue;
        const auto from = old.rim.edges.begin() + old.region->loop_starts[(*matches)[l]];
        std::copy_n(from, now.region->loop(l).size(),
                    now.rim.edges.begin() + now.region->loop_starts[l]);
      }
      rims.push_back(&now.rim);
    }
    return rims;
  }

  LiveStack& stack_;
  std::vector<SliceEdit> edits_;
  bool is_quiet_ = true;           // no region changes
  std::vector<Station> stations_;  // that come
  std::vector<Stations::node_type> old_;
  Station old_below_;
  Station old_above_;
  std::uint32_t old_next_number_;
  std::uint32_t old_next_id_;
  std::optional<std::pair<double, double>> ends_;
  SurfaceChange change_;
};

}  // namespace

SurfaceChange apply(LiveStack& stack, std::vector<SliceEdit> edits) {
  return StackEdit(stack, std::move(edits)).run();
}

}  // namespace loft
