// SPDX-License-Identifier: MIT
#include "reconstruct/out_of_core/label_ends.h"

#include <algorithm>
#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "reconstruct/out_of_core/read_region.h"

namespace loft {

LabelEnds::LabelEnds(const SliceSource& source, std::span<const Height> heights,
                     const Options& options, HeightSpan span)
    : source_(source), heights_(heights), options_(options) {
  find_low(span);
  find_high(span);
  const bool keeps_empty = options.cap != Cap::extend;
  const bool has_beyond = options.cap == Cap::extend || options.cap == Cap::dome;
  first_ = keeps_empty && low_ > 0 ? low_ - 1 : low_;
  last_ = keeps_empty && high_ + 1 < heights.size() ? high_ + 1 : high_;
  beyond_ = has_beyond && first_ == low_ && low_has_loops_ ? 1 : 0;
  const bool has_high_end = has_beyond && last_ == high_ && high_has_loops_;
  slab_count_ = last_ - first_ + beyond_ + (has_high_end ? 1 : 0);
}

std::optional<Window> LabelEnds::window(SlabRange range) const {
  const std::size_t first = range.first == 0 ? 0 : slabs_below(range.first);
  const bool is_last = range.bound + 1 == heights_.size();
  const std::size_t bound = is_last ? slab_count_ : slabs_below(range.bound);
  if (first == bound) return std::nullopt;
  Window window;
  window.first_region = first - std::min(first, slices_beside_range);
  window.is_bottom = window.first_region == 0;
  window.is_top = bound + slices_beside_range >= slab_count_;
  window.first_height = window.is_bottom ? first_ : first_ + window.first_region - beyond_;
  const std::size_t last = window.is_top ? last_ : first_ + bound + slices_beside_range - beyond_;
  window.height_count = last + 1 - window.first_height;
  window.first_slab = first - window.first_region;
  window.slab_bound = bound == slab_count_ ? Window::all : bound - window.first_region;
  return window;
}

/// Of the label, below a height: none up to where it begins, all from where it ends.
std::size_t LabelEnds::slabs_below(std::size_t height) const {
  if (height <= first_) return 0;
  return height >= last_ ? slab_count_ : height - first_ + beyond_;
}

Region LabelEnds::region(std::size_t height) {
  std::vector<Defect> ignored;
  std::set<std::string> labels;
  return read_region(source_, heights_[height], options_, ignored, labels, memory_);
}

void LabelEnds::find_low(HeightSpan span) {
  std::optional<Region> lowest;
  bool has_loops = false;
  for (std::size_t i = 0; i < heights_.size() && !has_loops; ++i) {
    if (heights_[i].z < span.lowest && !is_at(i, span.lowest)) continue;
    Region found = region(i);
    has_loops = found.has_loops();
    if (lowest || found.is_empty()) continue;
    low_ = i;
    low_has_loops_ = has_loops;
    lowest = std::move(found);
  }
  if (!has_loops) throw too_few_slices(nullptr);
}

void LabelEnds::find_high(HeightSpan span) {
  for (high_ = heights_.size() - 1; high_ > low_; --high_) {
    if (heights_[high_].z > span.highest) continue;
    const Region found = region(high_);
    if (found.is_empty()) continue;
    high_has_loops_ = found.has_loops();
    return;
  }
  high_has_loops_ = low_has_loops_;
  if (options_.cap == Cap::extend && !options_.gap) {
    const Region only = region(low_);
    throw too_few_slices(&only);
  }
}

/// Whether a slice of that z is one of those at a height, which its lowest stands for.
bool LabelEnds::is_at(std::size_t height, double z) const {
  return std::ranges::any_of(heights_[height].slices,
                             [&](std::uint32_t s) { return source_.slices[s].z == z; });
}

}  // namespace loft
