// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "overlay/polygon.h"
#include "paths/free_space.h"

namespace loft::paths {

// What can be seen from a place: what a straight way leads to. It may touch obstacles and walls and
// run along them, on one side of them or on both; it is on all sides of what it starts and ends on.
// A passage without width lets nothing through: at a vertex on the way, it goes on where it can
// turn there from how it came to how it leaves, on the left or on the right, over what is free; and
// it does not change from one side of a wall to the other.
//
// All decisions are exact. Preconditions of all: coordinates are usable
// (cdt::Triangulation::is_usable); what is not finite is nowhere, and sees nothing. Each throws
// std::logic_error if the space is stale.

/// Whether the segment from a to b is a way. Laws: the same for b and a; if shortest_path() has no
/// more than one piece, it is one; if it has more, it is not, unless their length, rounded, is that
/// of the segment; sees(a, a) if a is free. Cost: to locate a, then the triangles crossed, and the
/// degrees of vertices on the segment. It takes no memory.
[[nodiscard]] bool sees(const FreeSpace& space, Point a, Point b);

/// Where a ray ends.
struct Hit {
  /// A vertex, or where the ray crosses the edge, rounded.
  Point place;
  /// What it cannot pass: what it comes through is on the left. At a vertex, an edge there that is
  /// in the way. Decided exactly; valid until the next edit. FreeSpace::mesh().passages(edge) says
  /// whose it is.
  EdgeId edge;
  double distance = 0;

  friend bool operator==(const Hit&, const Hit&) = default;
};

/// The first place where the ray from p through `towards` cannot go on; p itself, where it cannot
/// leave. None if p is not free or both are the same. Cost: as sees().
[[nodiscard]] std::optional<Hit> first_hit(const FreeSpace& space, Point p, Point towards);

/// What is seen from p, but for what is seen along a single ray only, between corners that touch it
/// from both sides (Bungiu et al., "Efficient Computation of Visibility Polygons", 2014).
///
/// One ring for each part of what is free around p: one where p is inside of what is free or on its
/// border, two on a wall, and at a vertex one for each sector between obstacles and walls. They are
/// counter-clockwise and star-shaped around p, and have p as a corner where the sector is less than
/// a full turn. Each begins at its smallest point, and they are sorted. Their corners are vertices,
/// and rounded where a ray past a vertex meets an edge further away; which these are is decided
/// exactly. By as much as that rounds, a ring may touch or cross itself where what is seen is no
/// wider. None if p is not free.
///
/// Cost: to locate p, then the triangles seen, those that are seen in several parts once for each.
[[nodiscard]] std::vector<overlay::Ring> visible_region(const FreeSpace& space, Point p);

}  // namespace loft::paths
