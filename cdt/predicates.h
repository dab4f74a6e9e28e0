// SPDX-License-Identifier: MIT
#pragma once

#include "cdt/point.h"

namespace loft::cdt {

/// Exact geometric decisions on points with `double` coordinates, and the one rounded construction.
///
/// Each predicate is a floating-point filter with a derived error bound, then exact arithmetic on
/// expansions (after Shewchuk, "Adaptive Precision Floating-Point Arithmetic and Fast Robust
/// Geometric Predicates", 1997). Exact as long as no product of four (orient: two) coordinate
/// differences over- or underflows. Must be compiled without floating-point contraction.

/// Which side of the line a -> b the point c is on: +1 left, -1 right, 0 exactly on it.
/// Laws: orient(b,c,a) == orient(a,b,c); orient(b,a,c) == -orient(a,b,c);
/// 0 if two of the points are equal.
[[nodiscard]] int orient(Point a, Point b, Point c);

/// Whether d is inside the circle through a, b, c (counter-clockwise): +1 inside, -1 outside,
/// 0 exactly on it. Laws: an even permutation of the four points keeps the sign, an odd one turns it.
[[nodiscard]] int in_circle(Point a, Point b, Point c, Point d);

/// in_circle that never answers 0 for four different points, a, b, c counter-clockwise.
/// Ties are broken as if each point's height on the paraboloid x^2+y^2 were raised by its own
/// infinitesimal, the lexicographically largest point by far the most (Devillers and Teillaud,
/// "Perturbations and Vertex Removal in Delaunay Triangulations", 2003). So the answer depends on
/// the coordinates alone, and every point set has one Delaunay triangulation.
[[nodiscard]] int in_circle_perturbed(Point a, Point b, Point c, Point d);

/// Whether the open segments ab and cd cross in one point that is inside both (exact).
[[nodiscard]] bool crosses(Point a, Point b, Point c, Point d);

/// The intersection of the lines ab and cd, each coordinate correctly rounded (to nearest, even):
/// the result does not depend on the order of a and b, of c and d, or of the two lines.
/// Precondition: the lines are not parallel.
[[nodiscard]] Point intersection(Point a, Point b, Point c, Point d);

}  // namespace loft::cdt
