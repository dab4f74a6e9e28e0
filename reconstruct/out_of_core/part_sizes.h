// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace loft {

/// What a part made of a range consists of, in the order it is passed on, and what of it others
/// have too: the slice above it, and what sewing added in the slab below it and in the one above.
struct PartSizes {
  std::uint32_t plain = 0;            ///< vertices of slices and slabs
  std::uint32_t upper = 0;            ///< of the slice above: the next part begins with them
  std::uint32_t lower_doubled = 0;    ///< the last doubled vertices of the part below
  std::uint32_t doubled = 0;          ///< doubled vertices
  std::uint32_t midpoints = 0;        ///< midpoints
  std::uint32_t upper_midpoints = 0;  ///< the first midpoints of the part above
  std::uint64_t faces = 0;            ///< layer by layer
  std::uint32_t lower_cuts = 0;       ///< faces cut off where the part below is sewn on,
  std::uint32_t cuts = 0;             ///< inside,
  std::uint32_t upper_cuts = 0;       ///< and where the part above is
  std::uint32_t lower_seam = 0;       ///< as lower_cuts, with those of the part below
  std::uint32_t upper_seam = 0;       ///< as upper_cuts, with those of the part above

  friend bool operator==(const PartSizes&, const PartSizes&) = default;
};

}  // namespace loft
