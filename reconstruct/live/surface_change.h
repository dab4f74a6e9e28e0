// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "mesh/box3.h"
#include "reconstruct/defect.h"
#include "reconstruct/live/snapshot.h"

namespace loft {

/// What an edit made of the surface.
struct SurfaceChange {
  std::vector<std::uint32_t> removed;  ///< ids of the slabs that are gone, in ascending order
  std::vector<SlabInfo> added;         ///< those in their place, from low to high
  /// Ids of slabs that stay, beside those, though some of their faces are others now: where
  /// contours touch, what is joined there depends on both sides. In ascending order.
  std::vector<std::uint32_t> resewn;
  std::size_t vertices_added = 0;
  std::size_t vertices_removed = 0;
  std::size_t faces_added = 0;
  std::size_t faces_removed = 0;
  std::optional<Box3> bounds;  ///< of all faces that came or went
  /// What was found in the edited slices and in the slabs added. Defect::slice is the slice's
  /// number in order of arrival.
  std::vector<Defect> repairs;

  [[nodiscard]] bool is_empty() const { return removed.empty() && added.empty(); }
};

}  // namespace loft
