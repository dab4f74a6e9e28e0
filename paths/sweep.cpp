// SPDX-License-Identifier: MIT
#include "paths/sweep.h"

#include <algorithm>
#include <cmath>

#include "paths/directions.h"

namespace loft::paths {

using cdt::EdgeId;
using cdt::Point;
using cdt::TriangleId;
using cdt::Triangulation;

namespace {

[[nodiscard]] Direction between(Point a, Point b) { return {b.x - a.x, b.y - a.y}; }

[[nodiscard]] double square_to_segment(Point p, Point a, Point b) {
  const Direction way = between(a, b);
  const Direction to_p = between(a, p);
  const double along = dot(way, to_p);
  const double length = dot(way, way);
  if (along <= 0) return dot(to_p, to_p);
  if (along >= length) return dot(between(b, p), between(b, p));
  const double height = cross(way, to_p);
  return height * height / length;
}

[[nodiscard]] bool is_crossing(Point a, Point b, Point c, Point d) {
  const auto side = [](Point p, Point q, Point r) { return cross(between(p, q), between(p, r)); };
  return side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0;
}

[[nodiscard]] double square_between(Point a, Point b, Point c, Point d) {
  if (is_crossing(a, b, c, d)) return 0;
  return std::min({square_to_segment(a, c, d), square_to_segment(b, c, d),
                   square_to_segment(c, a, b), square_to_segment(d, a, b)});
}

}  // namespace

bool Sweep::is_clear(const Gaps& gaps, Point from, Point to, double radius, EdgeId near) {
  const Triangulation& mesh = gaps.mesh();
  if (seen_.size() < mesh.triangle_bound()) seen_.resize(mesh.triangle_bound());
  if (++sweep_ == 0) {
    std::ranges::fill(seen_, 0U);
    sweep_ = 1;
  }
  const double furthest =
      std::max({std::abs(from.x), std::abs(from.y), std::abs(to.x), std::abs(to.y)});
  const double least = radius - radius * 0x1p-40 - furthest * 0x1p-46;
  const double square = least > 0 ? least * least : 0;
  const auto visit = [&](TriangleId t) {
    if (seen_[t.index()] == sweep_) return;
    seen_[t.index()] = sweep_;
    front_.push_back(t);
  };
  front_.clear();
  const cdt::Location start = mesh.locate(from, near);
  for (const EdgeId e : {start.edge, mesh.twin(start.edge)})
    if (gaps.is_free(Triangulation::triangle(e))) visit(Triangulation::triangle(e));
  if (front_.empty()) return false;
  while (!front_.empty()) {
    const TriangleId t = front_.back();
    front_.pop_back();
    for (unsigned corner = 0; corner < 3; ++corner) {
      const EdgeId e = Triangulation::edge(t, corner);
      const Point a = mesh.point(mesh.from(e));
      const Point b = mesh.point(mesh.to(e));
      if (square_between(from, to, a, b) >= square) continue;
      const EdgeId beyond = gaps.beyond(e);
      if (beyond.is_none() ||
          (!gaps.is_foot(mesh.from(e)) && square_to_segment(a, from, to) < square))
        return false;
      visit(Triangulation::triangle(beyond));
    }
  }
  return true;
}

}  // namespace loft::paths
