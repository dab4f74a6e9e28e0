// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "cdt/triangulation.h"
#include "reconstruct/clean/region.h"
#include "reconstruct/defect.h"
#include "reconstruct/link/ends.h"
#include "reconstruct/link/pieces.h"
#include "reconstruct/live/live_surface.h"
#include "reconstruct/live/snapshot.h"
#include "reconstruct/options.h"
#include "reconstruct/sew/rim.h"
#include "reconstruct/shape/smooth.h"
#include "reconstruct/slice.h"
#include "reconstruct/surface.h"
#include "reconstruct/tile/tiles.h"

namespace loft {

/// A slice of the stack and what has been made of it.
struct Station {
  std::shared_ptr<const Slice> slice;   ///< null beyond the ends
  std::uint32_t number = Origin::none;  ///< in order of arrival
  std::shared_ptr<const Region> region;
  std::shared_ptr<const SliceShape> shape;  ///< where the surface is bent nearby
  std::vector<Defect> repairs;
  Rim rim;
};

using Stations = std::map<double, Station>;

/// A layer of the surface, and where it is in it.
using Faces = std::vector<Surface::FaceHandle>;

/// A slab of the stack: what is in the surface, and what its neighbours look at.
struct LiveSlab {
  std::shared_ptr<const FrozenSlab> frozen;
  std::shared_ptr<const Pieces> found;                      ///< before ends were linked
  EndPlan ends;                                             ///< what was linked and leant
  std::array<std::shared_ptr<const SliceShape>, 4> shapes;  ///< what it was bent by, if it was
  Faces faces;
  Faces bottom;  ///< of the caps
  Faces top;
  bool is_sewn_as_tiled = false;  ///< sewing has doubled nothing of it

  /// Whether it depends on the slices before and after it by its form.
  [[nodiscard]] bool is_bent() const { return shapes[1] != nullptr; }
};

/// All that a Reconstruction knows.
struct LiveStack {
  explicit LiveStack(Options wanted)
      : options(std::move(wanted)), surface(options.cap == Cap::open) {}

  /// The slices between which the surface is: the first and the last one that are not empty, or the
  /// empty ones next to these; none if that are not two. Cost: O(number of empty ones beyond).
  [[nodiscard]] std::optional<std::pair<Stations::iterator, Stations::iterator>> range();

  /// The lines of a slice that no part ends in. Precondition: it is between the ends.
  [[nodiscard]] std::vector<std::uint32_t> unused_lines_at(double z) const;

  Options options;
  Stations stations;                              ///< slices by their heights
  std::map<double, LiveSlab> slabs;               ///< by the heights they begin at
  std::optional<std::pair<double, double>> ends;  ///< the heights between which there are slabs
  Station below;                                  ///< for domes
  Station above;
  LiveSurface surface;
  std::uint32_t next_number = 0;  ///< of slices
  std::uint32_t next_id = 0;      ///< of slabs
  cdt::Triangulation memory;      ///< for cleaning
  TileWorkspace workspace;
};

}  // namespace loft
