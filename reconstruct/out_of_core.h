// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "mesh/measure.h"
#include "reconstruct/defect.h"
#include "reconstruct/link/link_report.h"
#include "reconstruct/options.h"
#include "reconstruct/out_of_core/part_sizes.h"
#include "reconstruct/out_of_core/slab_range.h"
#include "reconstruct/out_of_core/slice_source.h"
#include "reconstruct/progress.h"
#include "reconstruct/sew/surface_sink.h"

namespace loft {

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

/// How many slabs there are for ranges: one less than heights. Throws InputError as
/// reconstruct_out_of_core() does of heights.
[[nodiscard]] std::size_t count_slabs(const SliceSource& source, const Options& options);

/// What reconstruct_slabs() finds out beside the surface.
struct SlabsReport {
  OutOfCoreReport report;  ///< of the range only; no slab_volume, and the genus says nothing
  PartSizes sizes;
  /// The places of the first and the last cut faces among all of their seams.
  std::vector<std::uint32_t> lower_places;
  std::vector<std::uint32_t> upper_places;
};

/// As reconstruct_out_of_core(), of some slabs only: an open surface. Reads the slices of the
/// range, slices_beside_range ones on either side, and from the ends of the label's span as many as
/// it takes to find where it begins and ends.
///
/// Law: the parts of ranges that follow one another, joined (io/meshes/ply_join.h), are the surface
/// of the whole stack. A label that has nothing in the range makes an empty part. Throws InputError
/// before anything is passed on where the whole stack would be refused for lack of slices.
/// Precondition: first < bound <= count_slabs().
[[nodiscard]] SlabsReport reconstruct_slabs(const SliceSource& source, const Options& options,
                                            SlabRange range, HeightSpan span, SurfaceSink& sink,
                                            const Progress& progress = {});

}  // namespace loft
