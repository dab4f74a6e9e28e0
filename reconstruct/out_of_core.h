// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
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

/// How many slabs there are for ranges: one less than heights. Throws InputError as
/// reconstruct_out_of_core() does of heights.
[[nodiscard]] std::size_t count_slabs(const SliceSource& source, const Options& options);

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

/// What reconstruct_slabs() finds out beside the surface.
struct SlabsReport {
  OutOfCoreReport report;  ///< of the range only; no slab_volume, and the genus says nothing
  PartSizes sizes;
  /// The places of the first and the last cut faces among all of their seams.
  std::vector<std::uint32_t> lower_places;
  std::vector<std::uint32_t> upper_places;
};

/// Heights between which all contours of the label are, if that is known.
struct HeightSpan {
  double lowest = -std::numeric_limits<double>::infinity();
  double highest = std::numeric_limits<double>::infinity();
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
