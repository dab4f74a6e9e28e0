// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "reconstruct/live/snapshot.h"
#include "reconstruct/stack.h"

namespace loft::io {

/// How a slab is to be shown.
struct SlabView {
  std::string label;
  std::uint64_t edit = 0;  ///< that made it
  bool is_double_sided = false;
  Vec3 origin{};  ///< coordinates are relative to it; the node moves them back
  double metres_per_unit = 0.001;
  std::optional<Colour> colour = {};  ///< that its source gives the label; none: by its name
};

/// Slab i of a snapshot as GLB, for viewers that show a surface while it grows. As write_glb(): +Y
/// up, metres, smooth normals, here across slabs. The node's extras are label, low, high (heights
/// in the input's unit), confidence (SlabReport) and edit. Throws as write_glb(). Cost: that of the
/// slab and its neighbours.
[[nodiscard]] std::string slab_glb(const Snapshot& snapshot, std::size_t i, const SlabView& view);

/// Slabs in one GLB, as one mesh: for viewers that want many. `slabs` follow one another in the
/// snapshot; `view.edit` counts for none. The node's extras are label and `slabs`: of each its id,
/// low, high, confidence, edit, and how many `vertices` and `indices` are its; they share none and
/// come in that order. Cost: that of the slabs and their neighbours.
struct BundledSlab {
  std::size_t index = 0;   ///< in the snapshot
  std::string id;          ///< as the viewer knows it
  std::uint64_t edit = 0;  ///< that made it
};
[[nodiscard]] std::string bundle_glb(const Snapshot& snapshot, std::span<const BundledSlab> slabs,
                                     const SlabView& view);

/// The same of a patch that has its faces slab by slab: slabs `first` and those behind it, with
/// their ids; each has id, low, high. Cost: that of the patch.
[[nodiscard]] std::string bundle_glb(const Patch& patch, std::span<const SlabInfo> slabs,
                                     std::span<const std::string> ids, const SlabView& view);

/// The faces of a patch that belong to slab `info.id` (Patch::slabs), in the same way; extras are
/// label, low and high. Cost: that of the patch.
[[nodiscard]] std::string slab_glb(const Patch& patch, const SlabInfo& info, const SlabView& view);

}  // namespace loft::io
