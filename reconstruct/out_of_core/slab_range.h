// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <limits>

namespace loft {

/// Slabs of a stack, from `first` up to `bound`. Slab i is between the heights i and i + 1, of all
/// slices, whatever their labels; what lies beyond the first and last height of a label goes with
/// the slab beside it.
struct SlabRange {
  std::size_t first = 0;
  std::size_t bound = 0;

  friend bool operator==(const SlabRange&, const SlabRange&) = default;
};

/// So many slices on either side of a range have a say in it. Sewing numbers what it adds as the
/// slabs do that are next and next but one (a vertex where parts touch may begin in the slab
/// below); these are linked by what ends in the slabs beside them, and bent by the slices beside
/// them: one more. Everything else (fairing, cleaning, tiling, caps, refining) looks at no others.
inline constexpr std::size_t slices_beside_range = 3;

/// Heights between which all contours of the label are, if that is known.
struct HeightSpan {
  double lowest = -std::numeric_limits<double>::infinity();
  double highest = std::numeric_limits<double>::infinity();
};

}  // namespace loft
