// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <vector>

#include "reconstruct/clean/heights.h"
#include "reconstruct/clean/region.h"
#include "reconstruct/defect.h"
#include "reconstruct/options.h"

namespace loft {

/// The regions of a stack in the order of their heights, of the empty ones at both ends only the
/// nearest, with those that a cap puts beyond the ends; those that are no longer needed are
/// forgotten.
class RegionQueue {
 public:
  /// `is_bottom`: the first one that comes is the first there is. `gap` is that of a slice that is
  /// alone.
  RegionQueue(Cap cap, std::optional<double> gap, bool is_bottom);

  void add(Region region);
  /// There are more, but they do not come.
  void break_off() { append_empty(); }
  /// No more come. Throws InputError if there are too few.
  void end();

  [[nodiscard]] std::size_t bound() const { return first_ + regions_.size(); }
  [[nodiscard]] bool has(std::size_t i) const { return i >= first_ && i < bound(); }
  /// Stays where it is until it is dropped.
  [[nodiscard]] const Region& operator[](std::size_t i) const { return regions_[i - first_]; }
  void drop_below(std::size_t i) {
    for (; first_ < i; ++first_) regions_.pop_front();
  }

  /// Of all that came, without the first empty ones.
  [[nodiscard]] double slab_volume() const { return volume_.volume(); }
  /// Warnings of those that are empty.
  [[nodiscard]] const std::vector<Defect>& repairs() const { return repairs_; }

 private:
  void append_empty();
  void append(Region region);
  void count_volume(const Region& region);
  void extend_end();

  Cap cap_;
  std::optional<double> gap_;  // of a slice that is alone
  SlabVolume volume_;
  std::optional<Region> lowest_;  // the nearest empty one below the first filled one
  bool has_low_end_;
  std::deque<Region> regions_;
  std::size_t first_ = 0;
  bool has_filled_;
  bool has_loops_;
  std::vector<Region> empty_;  // above the last filled one
  std::vector<Defect> repairs_;
};

}  // namespace loft
