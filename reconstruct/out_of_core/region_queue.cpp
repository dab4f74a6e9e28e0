// SPDX-License-Identifier: MIT
#include "reconstruct/out_of_core/region_queue.h"

#include <utility>

namespace loft {

RegionQueue::RegionQueue(Cap cap, std::optional<double> gap, bool is_bottom)
    : cap_(cap),
      gap_(gap),
      volume_(gap.value_or(0)),
      has_low_end_(!is_bottom),
      has_filled_(!is_bottom),
      has_loops_(!is_bottom) {}

void RegionQueue::add(Region region) {
  count_volume(region);
  if (region.is_empty()) {
    if (!has_filled_ && cap_ == Cap::extend) return;
    if (!has_filled_) empty_.clear();  // only the nearest one counts
    empty_.push_back(std::move(region));
    return;
  }
  append_empty();
  has_filled_ = true;
  has_loops_ = has_loops_ || region.has_loops();
  append(std::move(region));
}

void RegionQueue::end() {
  if (!has_loops_) throw too_few_slices(nullptr);
  if (cap_ == Cap::extend) return extend_end();
  if (!empty_.empty()) append(std::move(empty_.front()));
  if (bound() < 2) throw too_few_slices(&regions_.front());
  if (cap_ == Cap::dome && regions_.back().has_loops())
    regions_.push_back(beyond(regions_.back(), regions_[regions_.size() - 2]));
}

void RegionQueue::append_empty() {
  for (Region& empty : std::exchange(empty_, {})) {
    if (has_filled_) repairs_.push_back(empty_slice(empty));
    append(std::move(empty));
  }
}

void RegionQueue::append(Region region) {
  regions_.push_back(std::move(region));
  if ((cap_ != Cap::dome && cap_ != Cap::extend) || bound() != 2 || has_low_end_) return;
  has_low_end_ = true;
  if (!regions_[0].has_loops()) return;
  regions_.push_front(cap_ == Cap::dome
                          ? beyond(regions_[0], regions_[1])
                          : extended(regions_[0], (regions_[0].z - regions_[1].z) / 2));
}

void RegionQueue::count_volume(const Region& region) {
  if (!has_filled_ && region.is_empty()) {
    lowest_ = region;
    return;
  }
  if (const auto lowest = std::exchange(lowest_, {})) volume_.add(*lowest);
  volume_.add(region);
}

void RegionQueue::extend_end() {
  const bool is_alone = bound() < 2;
  if (is_alone && !gap_) throw too_few_slices(&regions_.front());
  const Region& last = regions_.back();
  const double gap = is_alone ? *gap_ : last.z - regions_[regions_.size() - 2].z;
  if (!last.has_loops()) return;
  Region above = extended(last, gap / 2);
  if (is_alone) regions_.push_front(extended(last, -gap / 2));
  regions_.push_back(std::move(above));
}

}  // namespace loft
