// SPDX-License-Identifier: MIT
#include <cmath>
#include <utility>

#include "cdt/effort.h"
#include "cdt/predicates.h"
#include "cdt/triangulation.h"

namespace loft::cdt {

/// The last place, unless the locator knows a vertex that is nearer.
EdgeId Triangulation::hint_for(Point p) const {
  const VertexId near = locator_.near(p);
  if (near.is_none() || edge(near).is_none()) return last_;
  const auto distance = [&](VertexId v) {
    return std::abs(point(v).x - p.x) + std::abs(point(v).y - p.y);
  };
  const VertexId last = from(last_) == infinite ? to(last_) : from(last_);
  return distance(last) <= distance(near) ? last_ : edge(near);
}

/// A stochastic visibility walk (Devillers, Pion, Teillaud, "Walking in a Triangulation", 2002):
/// leave a triangle through an edge that has the point on its other side; of two such edges, now
/// one, now the other, so that it ends in any triangulation.
Location Triangulation::locate(Point p, EdgeId hint) const {
  spend(4);
  if (triangle_count() == 0 || !std::isfinite(p.x) || !std::isfinite(p.y)) return {};
  EdgeId e = hint.is_none() || !is_triangle(triangle(hint)) ? last_ : hint;
  if (is_flat_) return locate_flat(p, e);

  if (is_infinite(triangle(e))) {
    while (apex(e) != infinite) e = next(e);
    e = twin(e);
  }
  Point a = point(from(e));
  Point b = point(to(e));
  int here = orient(a, b, p);  // on which side of e p is, seen from its left
  if (here < 0) {
    e = twin(e);
    std::swap(a, b);
    here = 1;
  }
  VertexId ahead = apex(e);
  Point c = point(ahead);
  std::uint32_t dice = 0x2545'f491;
  while (ahead != infinite) {  // p is not beyond e, which goes from a to b; c is at the apex
    // Both ways out are looked at before it is known which to take: memory is slow to answer.
    const EdgeId ways[2] = {twin(next(e)), twin(prev(e))};
    const VertexId apexes[2] = {apex(ways[0]), apex(ways[1])};
    const Point corners[2] = {point(apexes[0]), point(apexes[1])};
    unsigned way = dice & 1;
    dice = dice * 1664525 + 1013904223;
    dice ^= dice >> 16;
    const auto side = [&] { return way == 0 ? orient(b, c, p) : orient(c, a, p); };
    if (const int one = side(); one >= 0) {
      way ^= 1;
      if (const int other = side(); other >= 0) {
        if (here > 0 && one > 0 && other > 0) return {Location::Kind::triangle, e};
        return settle(p, e);
      }
    }
    (way == 0 ? a : b) = c;
    e = ways[way];
    ahead = apexes[way];
    c = corners[way];
    here = 1;
  }
  return {Location::Kind::outside, e};
}

/// p is in the closed triangle left of e: inside, on which edge, or on which corner?
Location Triangulation::settle(Point p, EdgeId e) const {
  const auto is_on = [&](EdgeId side) {
    return orient(point(from(side)), point(to(side)), p) == 0;
  };
  for (const EdgeId side : {e, next(e), prev(e)})
    if (point(from(side)) == p) return {Location::Kind::vertex, side};
  for (const EdgeId side : {e, next(e), prev(e)})
    if (is_on(side)) return {Location::Kind::edge, side};
  return {Location::Kind::triangle, e};
}

/// While all vertices are in one line, the infinite triangles beside it form a ring: once along
/// the line on its left, once back on its right.
Location Triangulation::locate_flat(Point p, EdgeId e) const {
  while (apex(e) != infinite) e = next(e);
  const int side = orient(point(from(e)), point(to(e)), p);
  if (side != 0) return {Location::Kind::outside, side > 0 ? e : twin(e)};

  if ((point(from(e)) < point(to(e))) != (point(from(e)) < p)) e = twin(e);
  for (;;) {  // p is at from(e) or ahead
    if (point(from(e)) == p) return {Location::Kind::vertex, e};
    if (point(to(e)) == p) return {Location::Kind::vertex, next(e)};
    const bool is_inside = (point(from(e)) < p) == (p < point(to(e)));
    if (is_inside) return {Location::Kind::edge, e};
    const EdgeId ahead = next(twin(next(e)));  // the ring's next edge that is not to infinity
    if (ahead == twin(e)) return {Location::Kind::outside, next(e)};
    e = ahead;
  }
}

}  // namespace loft::cdt
