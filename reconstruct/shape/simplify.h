// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "reconstruct/surface.h"

namespace loft {

/// What simplify() did.
struct Simplification {
  std::size_t removed_vertices = 0;
  double distance = 0;  ///< no point of either surface is farther than that from the other one
};

/// Removes vertices as long as the surface stays within `tolerance` of what it was, by collapsing
/// edges into one of their ends: the vertices that stay have their places and origins. Collapses
/// that move the surface least come first, of those alike the ones that make better angles.
///
/// Guarantees:
/// - Both ways: every point of the surface given, so every contour vertex and edge too, is within
///   `tolerance` of the result, and every point of the result within `tolerance` of the surface
///   given. Each collapse maps the old faces around a vertex to the new ones along the mean of
///   their normals; how far that moves a point is known exactly, as it is largest where edges of
///   both cross, and adds up along the faces (Cohen, Manocha, Olano, "Successive Mappings", 2003).
///   So the bound is on a one-to-one map between the surfaces, not only on their distance. It
///   holds up to the rounding of its own arithmetic.
/// - A surface without faults stays without: the link condition keeps it manifold, no face turns by
///   90 degrees or more in a collapse, new triangles meet others in common corners and edges only
///   (exact test), and nothing is in the way of a collapse, so that what is inside of what stays
///   the same whatever the tolerance (exact test).
/// - With tolerance 0 only what changes nothing goes: vertices inside flat parts and on straight
///   edges, by exact decision.
/// - Rims of an open surface, and vertices at the place of another one (where parts touch), stay.
/// - The result depends on the places of the vertices, not on their numbers.
///
/// A face keeps the kind and slab of one that it came from. Numbers of vertices and faces change.
/// Precondition: tolerance >= 0; no deleted elements.
/// Cost: O(n log n) in practice.
Simplification simplify(Surface& surface, double tolerance);

}  // namespace loft
