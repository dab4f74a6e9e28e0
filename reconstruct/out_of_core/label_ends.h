// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <span>

#include "cdt/triangulation.h"
#include "reconstruct/clean/heights.h"
#include "reconstruct/clean/region.h"
#include "reconstruct/options.h"
#include "reconstruct/out_of_core/slab_range.h"
#include "reconstruct/out_of_core/slice_source.h"

namespace loft {

/// What is worked on of a label: heights, from the first region that counts or from one within it,
/// and which of the slabs between these regions are passed on. What is not told by heights is
/// counted from the first region worked on.
struct Window {
  static constexpr std::size_t all = std::numeric_limits<std::size_t>::max();

  std::size_t first_height = 0;
  std::size_t height_count = all;
  bool is_bottom = true;         // nothing is below
  bool is_top = true;            // nothing is above
  std::size_t first_region = 0;  // its number among all of the label
  std::size_t first_slab = 0;
  std::size_t slab_bound = all;  // all: up to the top
};

/// Where a label begins and ends among heights, and how its regions are numbered.
class LabelEnds {
 public:
  /// Keeps references to all. Reads slices from both ends of the span until there is something.
  /// Throws InputError if there are too few.
  LabelEnds(const SliceSource& source, std::span<const Height> heights, const Options& options,
            HeightSpan span);

  /// None if the label has nothing there.
  [[nodiscard]] std::optional<Window> window(SlabRange range) const;

 private:
  [[nodiscard]] std::size_t slabs_below(std::size_t height) const;
  [[nodiscard]] Region region(std::size_t height);
  void find_low(HeightSpan span);
  void find_high(HeightSpan span);
  [[nodiscard]] bool is_at(std::size_t height, double z) const;

  const SliceSource& source_;
  std::span<const Height> heights_;
  const Options& options_;
  cdt::Triangulation memory_;
  std::size_t low_ = 0;  // the first and the last height with a region that is not empty
  std::size_t high_ = 0;
  bool low_has_loops_ = false;
  bool high_has_loops_ = false;
  std::size_t first_ = 0;  // of the first and the last region, but for those beyond the ends
  std::size_t last_ = 0;
  std::size_t beyond_ = 0;  // regions below the first height
  std::size_t slab_count_ = 0;
};

}  // namespace loft
