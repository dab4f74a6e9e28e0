// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include "paths/shortest.h"

namespace loft::paths {

/// The paper's own way for discs: everything that blocks the way grown by a radius, circles being
/// regular polygons outside or inside of them.
class Grown {
 public:
  Grown(const FreeSpace& space, double radius, int corners, bool is_outside) {
    const LayerId free = overlay_.add_layer("free", overlay::FillRule::nonzero);
    const LayerId grown = overlay_.add_layer("grown", overlay::FillRule::nonzero);
    for (const auto& polygon : polygons(space)) overlay_.insert(free, polygon);
    const double half_step = std::numbers::pi / corners;
    const double reach = is_outside ? radius / std::cos(half_step) : radius;
    const auto around = [&](Point p) {
      std::vector<Point> ring;
      for (int i = 0; i < corners; ++i)
        ring.push_back(
            {p.x + reach * std::cos(2 * half_step * i), p.y + reach * std::sin(2 * half_step * i)});
      return ring;
    };
    std::vector<std::vector<Point>> rings;
    const auto grow = [&](Point a, Point b) {
      const double length = std::sqrt((b.x - a.x) * (b.x - a.x) + (b.y - a.y) * (b.y - a.y));
      const double x = (b.x - a.x) / length * radius;
      const double y = (b.y - a.y) / length * radius;
      rings.push_back(
          {{a.x + y, a.y - x}, {b.x + y, b.y - x}, {b.x - y, b.y + x}, {a.x - y, a.y + x}});
      rings.push_back(around(a));
      rings.push_back(around(b));
    };
    const Triangulation& mesh = space.mesh();
    for (std::uint32_t i = 0; i < mesh.edge_bound(); ++i) {
      const EdgeId e(i);
      if (!mesh.is_triangle(Triangulation::triangle(e)) || !mesh.is_constrained(e)) continue;
      if (!space.is_free(Triangulation::triangle(e)) || !space.beyond(e).is_none()) continue;
      grow(mesh.point(mesh.from(e)), mesh.point(mesh.to(e)));
    }
    std::vector<overlay::Shape> shapes;
    for (const auto& ring : rings) shapes.push_back({grown, ring});
    overlay_.insert(shapes);
    space_ = std::make_unique<FreeSpace>(overlay_, overlay::Expression(free) - grown);
  }

  [[nodiscard]] const FreeSpace& space() const { return *space_; }

 private:
  /// The free triangles.
  [[nodiscard]] static std::vector<std::vector<Point>> polygons(const FreeSpace& space) {
    std::vector<std::vector<Point>> result;
    const Triangulation& mesh = space.mesh();
    for (std::uint32_t i = 0; i < mesh.triangle_bound(); ++i) {
      const TriangleId t(i);
      if (!mesh.is_triangle(t) || !space.is_free(t)) continue;
      const EdgeId e = Triangulation::edge(t);
      result.push_back(
          {mesh.point(mesh.from(e)), mesh.point(mesh.to(e)), mesh.point(mesh.apex(e))});
    }
    return result;
  }

  overlay::Overlay overlay_;
  std::unique_ptr<FreeSpace> space_;
};

}  // namespace loft::paths
