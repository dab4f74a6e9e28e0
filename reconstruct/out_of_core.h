// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "mesh/measure.h"
#include "reconstruct/defect.h"
#include "reconstruct/link/link_report.h"
#include "reconstruct/options.h"
#include "reconstruct/progress.h"
#include "reconstruct/sew/surface_sink.h"
#include "reconstruct/slice.h"
#include "reconstruct/usable.h"

namespace loft {

/// A stack that is not in memory.
struct SliceSource {
  struct Entry {
    double z = 0;
    std::size_t points = 0;  ///< about: so that pieces of work are of one size
  };
  std::vector<Entry> slices;  ///< in the order of the input
  /// Slice i. Called by several threads at once; exceptions are passed on.
  std::function<Slice(std::uint32_t i)> read;
};

/// What reconstruct_out_of_core() finds out beside the surface.
struct OutOfCoreReport {
  std::vector<Defect> repairs;    ///< as those of Reconstructed
  std::vector<SlabReport> slabs;  ///< from low to high; only with Options::reports_slabs
  Measures measures;
  std::array<std::size_t, 4> vertices_of_kind{};  ///< by VertexKind
  double slab_volume = 0;                         ///< as that of Reconstructed
};

/// Makes the surface of a stack larger than memory slab by slab, from the lowest slice upwards, and
/// passes it on piece by piece: the vertices and faces of reconstruct(), in the same order.
///
/// In memory are a few slices and slabs, the reports, and the vertices and faces that only parts
/// which touch need. Throws as reconstruct() does; but of slices with unusable coordinates
/// one is listed: call find_unusable() beforehand to have all. What the sink
/// got is of no use then. Throws std::invalid_argument for Options::simplify and Options::links,
/// which need the whole stack.
/// Progress has one stage, Stage::tile. Cost: O(n log n).
[[nodiscard]] OutOfCoreReport reconstruct_out_of_core(const SliceSource& source,
                                                      const Options& options, SurfaceSink& sink,
                                                      const Progress& progress = {});

}  // namespace loft
