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
/// A vertex on a rim of an open surface goes along the rim only, and rims keep first what they
/// need (`rim_vertices.h`).
///
/// Guarantees:
/// - Both ways: every point of the surface given, so every contour vertex and edge too, is within
///   `tolerance` of the result, and every point of the result within `tolerance` of the surface
///   given. Each collapse is measured against the surface given, not against the one before it
///   (`witnesses.h`), so nothing adds up. The bound holds up to the rounding of its own arithmetic.
///   What orders the collapses is a bound that adds up: how far a map along a normal moves the
///   faces around a vertex, exactly (Cohen, Manocha, Olano, "Successive Mappings", 2003).
/// - A surface without faults stays without: the link condition keeps it manifold, no face turns by
///   90 degrees or more in a collapse, new triangles meet others in common corners and edges only
///   (exact test), and nothing is in the way of a collapse, so that what is inside of what stays
///   the same whatever the tolerance (exact test).
/// - With tolerance 0 only what changes nothing goes: vertices inside flat parts and on straight
///   edges, by exact decision.
/// - Vertices at the place of another one (where parts touch) stay.
/// - The result depends on the places of the vertices, not on their numbers.
///
/// A face keeps the kind and slab of one that it came from. Numbers of vertices and faces change.
/// Precondition: tolerance >= 0; no deleted elements.
/// Cost: O(n log n) in practice.
Simplification simplify(Surface& surface, double tolerance);

}  // namespace loft
