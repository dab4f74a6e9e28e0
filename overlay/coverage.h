// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "overlay/overlay.h"

namespace loft::overlay {

/// A coverage is a map whose areas belong to one layer each: countries, parcels, classes of soil.
/// What is not so in a real one, and what to do about it.

/// A place that more than one layer claims, or none.
struct CoverageFault {
  /// Of an overlap, who claims it; of a gap, who is around it. Sorted.
  std::vector<LayerId> layers;
  Polygon polygon;
  ExactArea area;
  /// The diameter of the largest disc inside, to `width_precision` of it.
  double width = 0;
};
inline constexpr double width_precision = 1e-3;

struct CoverageFaults {
  std::vector<CoverageFault> overlaps;
  std::vector<CoverageFault> gaps;  ///< what is enclosed by layers and belongs to none
};

/// All overlaps and gaps, sorted by their outlines' smallest points. Exact but for the widths.
/// Cost: O(triangles), and for each width what it takes to find it in that polygon.
[[nodiscard]] CoverageFaults check_coverage(const Overlay& overlay);

/// Who gets a place that several claim, or none.
enum class Heir {
  longest_border,  ///< of those who may, who has the longest border with it
  first,           ///< the one that was added first
};

struct CleanOptions {
  Heir heir = Heir::longest_border;
  /// Gaps whose width is less are closed; others are seas and stay.
  double gap_width = 0;
};

/// The map without overlaps, and without gaps narrower than asked: by layer, as polygons() are.
/// What one layer alone claimed stays its own, and what belonged to none stays so unless it was
/// such a gap. An overlap goes to one of its claimants, a gap to one of those around it. Neighbours
/// have the same vertices along their border (Vertices::all), so that nothing opens between them.
[[nodiscard]] std::vector<MultiPolygon> clean_coverage(const Overlay& overlay,
                                                       const CleanOptions& options);

/// Where one layer's border is the other's, and they are on different sides of it.
struct SharedBorder {
  std::vector<std::vector<Point>> lines;  ///< each as far as it goes on; `a` on its left
  double length = 0;
};
[[nodiscard]] SharedBorder shared_border(const Overlay& overlay, LayerId a, LayerId b);

/// The layers that share a border with another, with its length; sorted by layer. Cost: O(edges).
struct Neighbour {
  LayerId layer;
  double length = 0;
};
[[nodiscard]] std::vector<Neighbour> neighbours(const Overlay& overlay, LayerId layer);

/// Borders, each once, and polygons made of them, as TopoJSON has it.
struct Topology {
  /// An arc, forwards, or backwards: then it is ~number.
  using ArcNumber = std::int32_t;
  using ArcRing = std::vector<ArcNumber>;

  std::vector<std::vector<Point>> arcs;  ///< a closed one ends where it began
  /// By layer: polygons, each an outer ring and holes.
  std::vector<std::vector<std::vector<ArcRing>>> layers;
};

/// The borders of all layers, cut where more than two pieces meet. Cost: O(edges).
[[nodiscard]] Topology arcs(const Overlay& overlay);

/// The polygons that a topology says a layer has.
[[nodiscard]] MultiPolygon polygons(const Topology& topology, LayerId layer);

}  // namespace loft::overlay
