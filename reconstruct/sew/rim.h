// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "reconstruct/clean/region.h"
#include "reconstruct/sew/sewing.h"
#include "reconstruct/surface.h"

namespace loft {

/// The edges of the surface that lie in a slice.
struct Rim {
  /// For each loop vertex of the slice's region the half-edge from it to the next: it belongs to a
  /// face above the slice, the opposite one to a face below it. Invalid where there is none yet.
  std::vector<Surface::HalfedgeHandle> edges;
  /// Whether that is all there is in the slice. Where slices hardly differ, more tiles may touch a
  /// contour edge; then layers on both sides can only be sewn together.
  bool is_regular = true;
};

/// A slice with its place in the surface.
struct RimmedSlice {
  const Region* region = nullptr;  ///< null: nothing, beyond a cap
  Rim* rim = nullptr;
};

/// A half-edge of a face that lies in a slice. A layer's faces run along the loops of the slice
/// below them, and against those of the slice above.
struct RimPlace {
  std::uint32_t slice;  ///< which one
  std::uint32_t place;  ///< where on its rim
  bool is_above;        ///< the face is above the slice
};

/// The half-edges of sewn layers that lie in slices.
class RimPlaces {
 public:
  RimPlaces() = default;
  /// Of the layers from `first` up to but not `last`; `slices`: below each, and above the last one.
  /// `is_partial`: some contour edges may have no face.
  /// Cost: O(n).
  RimPlaces(const Sewing& sewing, std::uint32_t first, std::uint32_t last,
            std::span<const RimmedSlice> slices, bool is_partial);

  /// Null for a half-edge that lies in no slice, or across a cap.
  [[nodiscard]] const RimPlace* find(HalfEdge h) const;
  /// The slices, by their number, in which a contour edge has not one face on either side.
  [[nodiscard]] std::span<const std::uint32_t> irregular() const { return irregular_; }

 private:
  std::uint32_t first_layer_ = 0;
  std::vector<std::vector<std::uint32_t>> numbers_;  // of each half-edge of each layer, or none
  std::vector<RimPlace> places_;
  std::vector<std::uint32_t> irregular_;
};

}  // namespace loft
