// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "cdt/triangulation.h"
#include "overlay/border.h"
#include "overlay/layer.h"
#include "overlay/polygon.h"

namespace loft::overlay {

/// Which region each triangle belongs to: that of its cover, or of any other mark. A view.
struct Regions {
  const cdt::Triangulation* mesh = nullptr;
  std::span<const CoverId> covers;           ///< by triangle
  std::span<const std::uint32_t> region_of;  ///< by cover; 0 is outside of all

  [[nodiscard]] std::uint32_t at(cdt::TriangleId t) const {
    return region_of[covers[t.index()].index()];
  }
  [[nodiscard]] std::uint32_t left_of(EdgeId e) const {
    return at(cdt::Triangulation::triangle(e));
  }
  [[nodiscard]] std::uint32_t right_of(EdgeId e) const { return left_of(mesh->twin(e)); }
  /// Whether there is a region on its left, and not on its right.
  [[nodiscard]] bool has_border(EdgeId e) const {
    const std::uint32_t left = left_of(e);
    return left != 0 && right_of(e) != left;
  }
};

/// A simple ring, edge by edge, with its region on the left. Begins at its smallest point.
using TracedRing = std::vector<EdgeId>;

struct TracedPolygon {
  std::uint32_t region = 0;
  TracedRing outer;
  std::vector<TracedRing> holes;
};

/// The polygons of regions, from their border edges: sorted, each with a connected inside.
///
/// At each vertex a walk along the border keeps to the triangles on its left, so that it goes once
/// around one part of a region that is joined by edges. Where it comes to a vertex again it is
/// cut: its loops are simple rings, of which one is counter-clockwise if it was the outer border.
/// A walk of holes alone belongs to what is met first on a way through the region to the left.
///
/// Precondition: no infinite triangle belongs to a region.
[[nodiscard]] std::vector<TracedPolygon> trace(const Regions& regions,
                                               std::span<const BorderEdge> border);

/// The rings that some border edges are on. Cost: O(their length).
[[nodiscard]] std::vector<TracedRing> trace_through(const Regions& regions,
                                                    std::span<const BorderEdge> some);

/// The edges between triangles of different covers, one of two twins, as they lie in memory. Cost:
/// O(triangles).
[[nodiscard]] std::vector<EdgeId> find_fences(const cdt::Triangulation& mesh,
                                              std::span<const CoverId> covers);

/// The border edges of all regions, which are at the fences of their covers.
[[nodiscard]] std::vector<BorderEdge> borders(const Regions& regions,
                                              std::span<const EdgeId> fences);
/// The same. Cost: O(triangles).
[[nodiscard]] std::vector<BorderEdge> borders(const Regions& regions);

/// The points of a ring. `leave_out_straight`: without those where it only runs on exactly straight
/// along one inserted segment.
[[nodiscard]] Ring points_of(const cdt::Triangulation& mesh, const TracedRing& ring,
                             bool leave_out_straight);
[[nodiscard]] Polygon points_of(const cdt::Triangulation& mesh, const TracedPolygon& polygon,
                                bool leave_out_straight);

}  // namespace loft::overlay
