// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

#include "fields/field.h"

namespace loft::fields {

/// Where a linear surface comes to a level.
class Level {
 public:
  Level(const Field& field, double level) : field_(field), level_(level) {}

  /// Whether the corner that an edge starts from is at the level or higher.
  [[nodiscard]] bool is_above(EdgeId e) const { return field_.corner_value(e) >= level_; }
  /// Whether the surface goes down through the level along an edge, in its triangle.
  [[nodiscard]] bool falls(EdgeId e) const {
    return is_above(e) && !is_above(Triangulation::next(e));
  }
  /// Where an edge that goes through the level does so; the same seen from both sides.
  [[nodiscard]] Point crossing(EdgeId e) const {
    const Triangulation& mesh = field_.mesh();
    Point a = mesh.point(mesh.from(e));
    Point b = mesh.point(mesh.to(e));
    double start = field_.corner_value(e);
    double end = field_.corner_value(Triangulation::next(e));
    if (b < a) {
      std::swap(a, b);
      std::swap(start, end);
    }
    if (start == level_) return a;
    if (end == level_) return b;
    const double t = std::clamp((level_ - start) / (end - start), 0.0, 1.0);
    return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
  }
  /// The edge of a triangle along which it falls through the level; none if it is not crossed.
  [[nodiscard]] EdgeId falling_edge(TriangleId t) const {
    for (unsigned corner = 0; corner < 3; ++corner)
      if (const EdgeId e = Triangulation::edge(t, corner); falls(e)) return e;
    return {};
  }
  /// That along which it rises again. Precondition: it is crossed.
  [[nodiscard]] EdgeId rising_edge(EdgeId falling) const {
    const EdgeId next = Triangulation::next(falling);
    return is_above(Triangulation::next(next)) ? next : Triangulation::next(next);
  }

 private:
  const Field& field_;
  double level_;
};

/// Whether a triangle is finite and has a value at each corner.
[[nodiscard]] inline bool has_surface(const Field& field, TriangleId t) {
  if (!field.mesh().is_triangle(t) || field.mesh().is_infinite(t)) return false;
  for (unsigned corner = 0; corner < 3; ++corner) {
    const double value = field.corner_value(Triangulation::edge(t, corner));
    if (value != value) return false;
  }
  return true;
}

}  // namespace loft::fields
