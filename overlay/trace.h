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

/// Which triangles belong to a result: those whose covers do. A view.
struct Region {
  const cdt::Triangulation* mesh = nullptr;
  std::span<const CoverId> covers;      ///< by triangle
  std::span<const std::uint8_t> is_in;  ///< by cover

  [[nodiscard]] bool has(cdt::TriangleId t) const { return is_in[covers[t.index()].index()] != 0; }
  [[nodiscard]] bool has_left_of(EdgeId e) const { return has(cdt::Triangulation::triangle(e)); }
  [[nodiscard]] bool has_right_of(EdgeId e) const { return has_left_of(mesh->twin(e)); }
  [[nodiscard]] bool has_border(EdgeId e) const { return has_left_of(e) && !has_right_of(e); }
};

/// A simple ring, edge by edge, with the region on its left. Begins at its smallest point.
using TracedRing = std::vector<EdgeId>;

struct TracedPolygon {
  TracedRing outer;
  std::vector<TracedRing> holes;
};

/// The polygons of a region, from its border edges: sorted, each with a connected inside.
///
/// At each vertex a walk along the border keeps to the triangles on its left, so that it goes once
/// around one part of the region that is joined by edges. Where it comes to a vertex again it is
/// cut: its loops are simple rings, of which one is counter-clockwise if it was the outer border.
/// A walk of holes alone belongs to what is met first on a way through the region to the left.
///
/// Precondition: no infinite triangle belongs to it.
[[nodiscard]] std::vector<TracedPolygon> trace(const Region& region,
                                               std::span<const BorderEdge> border);

/// The rings that some border edges are on. Cost: O(their length).
[[nodiscard]] std::vector<TracedRing> trace_through(const Region& region,
                                                    std::span<const BorderEdge> some);

/// The points of a ring. `leave_out_straight`: without those where it only runs on exactly straight
/// along one inserted segment.
[[nodiscard]] Ring points_of(const cdt::Triangulation& mesh, const TracedRing& ring,
                             bool leave_out_straight);

}  // namespace loft::overlay
