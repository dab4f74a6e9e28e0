// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

#include "mesh/mesh.h"
#include "reconstruct/clean/region.h"
#include "reconstruct/link/link_report.h"
#include "reconstruct/link/pieces.h"
#include "reconstruct/options.h"
#include "reconstruct/origin.h"
#include "reconstruct/slice.h"
#include "reconstruct/surface.h"
#include "reconstruct/tile/tiles.h"

namespace loft {

/// A slab of a Reconstruction. The first and the last one have the caps.
struct SlabInfo {
  std::uint32_t id = 0;
  double low = 0;  ///< heights of the slices that it is between
  double high = 0;

  friend bool operator==(const SlabInfo&, const SlabInfo&) = default;
};

/// Some slabs as one mesh. Vertices are shared between slabs as far as contours are.
struct Patch {
  Mesh mesh;
  std::vector<Origin> origins;       ///< of each point; the slice counted from below
  std::vector<FaceKind> kinds;       ///< of each face
  std::vector<std::uint32_t> slabs;  ///< of each face: the index of its slab in the snapshot
};

/// A slab as it was when it was made; never changed.
struct FrozenSlab {
  SlabInfo info{};
  std::shared_ptr<const Region> lower{};
  std::shared_ptr<const Region> upper{};
  std::shared_ptr<const TileSet> tiles{};  ///< as they are in the surface
  std::shared_ptr<const TileSet>
      linked{};                  ///< as linking left them: the same, unless they were bent
  std::vector<bool> at_forks{};  ///< which of the latter were bent, if not all
  std::shared_ptr<const Pieces> pieces{};  ///< of the latter
  double volume = 0;                       ///< enclosed between the slices
  bool has_bottom_cap = false;             ///< what is flat below and above the tiles
  bool has_top_cap = false;
};

/// The volume that tiles enclose between their slices: that of prisms down to the lower slice,
/// under each tile and under the upper region. Cost: O(tiles).
[[nodiscard]] double volume(const Region& lower, const Region& upper, const TileSet& tiles);

/// A Reconstruction at one time: small, never changing, safe to use in any thread.
class Snapshot {
 public:
  Snapshot() = default;
  /// `numbers`: of each slice in order of arrival, as regions know it. Used by Reconstruction.
  Snapshot(std::vector<std::shared_ptr<const FrozenSlab>> slabs,
           std::vector<std::shared_ptr<const Slice>> slices, std::span<const std::uint32_t> numbers,
           Cap cap)
      : slabs_(std::move(slabs)), slices_(std::move(slices)), cap_(cap) {
    for (const std::uint32_t number : numbers)
      ranks_.emplace(number, static_cast<std::uint32_t>(ranks_.size()));
  }

  [[nodiscard]] std::size_t slab_count() const { return slabs_.size(); }
  [[nodiscard]] const SlabInfo& slab(std::size_t i) const { return slabs_[i]->info; }
  /// How sure the surface is there, and what it links, with slices counted from below. Cost: that
  /// of the slab.
  [[nodiscard]] SlabReport report(std::size_t i) const;
  /// The faces between the slices of a slab, without caps.
  [[nodiscard]] std::size_t tile_count(std::size_t i) const {
    return slabs_[i]->tiles->tiles.size();
  }
  /// The index of a slab, or slab_count() if there is none of that id.
  [[nodiscard]] std::size_t find(std::uint32_t id) const;

  [[nodiscard]] double volume() const;  ///< of all slabs

  [[nodiscard]] std::size_t slice_count() const { return slices_.size(); }
  [[nodiscard]] const Slice& slice(std::size_t i) const { return *slices_[i]; }

  /// The whole surface, slices and slabs counted from below, as reconstruct() gives them: a closed
  /// solid, parts that only touch kept apart. Empty if there is none. Cost: O(n).
  [[nodiscard]] Surface surface(unsigned threads = 0) const;
  /// The slabs from `first` up to but not `last`, as they are, with the caps that they own: to be
  /// drawn. Cost: that of these slabs.
  [[nodiscard]] Patch patch(std::size_t first, std::size_t last) const;

 private:
  [[nodiscard]] std::uint32_t rank(std::uint32_t number) const;

  std::vector<std::shared_ptr<const FrozenSlab>> slabs_;
  std::vector<std::shared_ptr<const Slice>> slices_;
  std::unordered_map<std::uint32_t, std::uint32_t> ranks_;  // of the slices, by their numbers
  Cap cap_ = Cap::flat;
};

}  // namespace loft
