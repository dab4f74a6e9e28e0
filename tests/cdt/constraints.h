// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <random>
#include <vector>

#include "cdt/check.h"
#include "cdt/triangulation.h"

namespace loft::cdt {

/// A polyline to insert.
struct OwnPolyline {
  std::vector<Point> points;
  Ends ends = open;
};

/// What coordinates random polylines have.
enum class Places { grid, decimals, far_from_origin, nearly_equal };
inline constexpr Places all_places[] = {Places::grid, Places::decimals, Places::far_from_origin,
                                        Places::nearly_equal};

/// Up to twelve polylines of up to eight points that cross, overlap and repeat themselves.
inline std::vector<OwnPolyline> random_polylines(std::uint64_t seed, Places places) {
  std::mt19937_64 random(seed);
  const auto below = [&](std::uint64_t n) { return static_cast<double>(random() % n); };
  const auto coordinate = [&] {
    switch (places) {
      case Places::grid:
        return below(8);
      case Places::decimals:
        return below(1000) / 1000;
      case Places::far_from_origin:
        return 5e6 + below(100) / 7;
      case Places::nearly_equal:
        break;
    }
    return below(3) + below(1000) * 1e-16;
  };
  std::vector<OwnPolyline> polylines(1 + random() % 12);
  for (OwnPolyline& polyline : polylines) {
    polyline.points.resize(1 + random() % 8);
    for (Point& p : polyline.points) {
      p.x = coordinate();
      p.y = coordinate();
    }
    polyline.ends = random() % 2 == 0 ? open : closed;
  }
  return polylines;
}

/// The finite triangles by the places of their corners, in an order of their own: equal for equal
/// triangulations, whatever their ids.
inline std::vector<std::array<Point, 3>> triangles_of(const Triangulation& mesh) {
  std::vector<std::array<Point, 3>> triangles;
  for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
    if (mesh.is_infinite(TriangleId(t))) continue;
    const EdgeId e = Triangulation::edge(TriangleId(t));
    std::array corners{mesh.point(mesh.from(e)), mesh.point(mesh.to(e)), mesh.point(mesh.apex(e))};
    std::rotate(corners.begin(), std::ranges::min_element(corners), corners.end());
    triangles.push_back(corners);
  }
  std::ranges::sort(triangles);
  return triangles;
}

/// The first thing that check() finds, as text; empty if there is nothing.
inline std::string first_fault(const Triangulation& mesh) {
  const auto findings = check(mesh);
  return findings.empty() ? "" : findings.front().message;
}

}  // namespace loft::cdt
