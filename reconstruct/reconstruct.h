// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <string>
#include <vector>

#include "reconstruct/contours_by_label.h"
#include "reconstruct/defect.h"
#include "reconstruct/link/link_report.h"
#include "reconstruct/options.h"
#include "reconstruct/progress.h"
#include "reconstruct/slice.h"
#include "reconstruct/stack.h"
#include "reconstruct/surface.h"

namespace loft {

/// A surface and what was found and repaired on the way to it.
struct Reconstructed {
  Surface surface;
  std::vector<Defect> repairs;    ///< in the order of heights; none is fatal
  std::vector<SlabReport> slabs;  ///< from low to high; only with Options::reports_slabs
  /// The volume as planning systems and counts of voxels have it: of each slice its area times its
  /// thickness, half the gap to either neighbour; see slab_volume().
  double slab_volume = 0;
};

/// Thrown by reconstruct() when its Progress asked for it.
class Cancelled : public Error {
 public:
  Cancelled() : Error("cancelled") {}
};

/// The closed surface through all contours of a stack of slices.
///
/// Guarantees, for every input: the surface is closed (unless Cap::open), manifold, oriented
/// outwards, without degenerate faces and without self-intersections; cut at the height of a slice
/// it gives that slice's region; every vertex of a clean contour is a vertex of the surface, with
/// the same coordinates. The result depends on the set of slices and contours, not on their order.
///
/// Options::simplify keeps contours and regions within its distance only; see simplify().
///
/// Between slices that nearly coincide, rounding may leave no valid surface, in about one of a
/// thousand: both then end half way, as if nothing overlapped, and DefectKind::unlinked_slices is
/// among the repairs.
///
/// Slices may come in any order of height; those of equal height are merged. A slice without a
/// contour (with Options::label: with that label) says that there is nothing at its height: a part
/// ends before it, whatever else is there. Of leading and trailing empty slices the nearest counts,
/// the others are left out. What goes on to the first or the last slice of all is capped there.
/// Throws InputError with all fatal defects: a coordinate that is not finite or of no usable size
/// (mesh/admitted.h), slices so near to one another that rounding leaves nothing
/// between them, no slice with an area, or nothing but one such slice; link orders that no stack
/// could meet (find_bad_orders()), contours of several labels without Options::label, edge lengths
/// that ask for too many triangles (split_long_edges()). Cost: O(n log n) for n contour points, in
/// practice; memory in proportion to the result.
[[nodiscard]] Reconstructed reconstruct(std::span<const Slice> slices, const Options& options = {},
                                        const Progress& progress = {});

/// The same for Options::label, which has to be set, where `contours` are those of the stack: for
/// many labels in turn, each of which then costs what its own contours do, and its share of
/// heights.
[[nodiscard]] Reconstructed reconstruct(std::span<const Slice> slices,
                                        const ContoursByLabel& contours, const Options& options,
                                        const Progress& progress = {});

/// The surface through a stack, in the world: its fill rule and keyhole width are the stack's where
/// that has one. Vertices of contours are where the file has them; where its points lie so far off
/// their planes that the surface would meet itself, they are in their planes, and
/// DefectKind::off_plane is among the repairs.
[[nodiscard]] Reconstructed reconstruct(const Stack& stack, const Options& options = {},
                                        const Progress& progress = {});

/// The same for Options::label, which has to be set; see above.
[[nodiscard]] Reconstructed reconstruct(const Stack& stack, const ContoursByLabel& contours,
                                        const Options& options, const Progress& progress = {});

/// The labels in a stack, sorted, each once; a contour without label counts as "".
[[nodiscard]] std::vector<std::string> labels(std::span<const Slice> slices);

}  // namespace loft
