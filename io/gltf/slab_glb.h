// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "reconstruct/live/snapshot.h"

namespace loft::io {

/// How a slab is to be shown.
struct SlabView {
  std::string label;
  std::uint64_t edit = 0;  ///< that made it
  bool is_double_sided = false;
  Vec3 origin{};  ///< coordinates are relative to it; the node moves them back
  double metres_per_unit = 0.001;
};

/// Slab i of a snapshot as GLB, for viewers that show a surface while it grows. As write_glb(): +Y
/// up, metres, smooth normals, here across slabs. The node's extras are label, low, high (heights
/// in the input's unit), confidence (SlabReport) and edit. Throws as write_glb(). Cost: that of the
/// slab and its neighbours.
[[nodiscard]] std::string slab_glb(const Snapshot& snapshot, std::size_t i, const SlabView& view);

/// The faces of a patch that belong to slab `info.id` (Patch::slabs), in the same way; extras are
/// label, low and high. Cost: that of the patch.
[[nodiscard]] std::string slab_glb(const Patch& patch, const SlabInfo& info, const SlabView& view);

}  // namespace loft::io
