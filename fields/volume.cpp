// SPDX-License-Identifier: MIT
#include "fields/volume.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

#include "cdt/regions.h"
#include "fields/level.h"
#include "fields/patch.h"

namespace loft::fields {

namespace {

/// A sum that does not depend on the order in which its terms come, compensated (Neumaier 1974).
class OrderlySum {
 public:
  void add(double term) { terms_.push_back(term); }
  [[nodiscard]] double total() {
    std::sort(terms_.begin(), terms_.end());
    double sum = 0;
    double lost = 0;
    for (const double term : terms_) {
      const double next = sum + term;
      lost += std::abs(sum) >= std::abs(term) ? (sum - next) + term : (term - next) + sum;
      sum = next;
    }
    return sum + lost;
  }

 private:
  std::vector<double> terms_;
};

/// Adds up prisms over triangles whose tops are slanted.
class Prisms {
 public:
  void add(std::array<Point, 3> corners, std::array<double, 3> heights) {
    const double area =
        std::abs(cross(way(corners[0], corners[1]), way(corners[0], corners[2]))) / 2;
    std::sort(heights.begin(), heights.end());
    const double whole = area * (heights[0] + heights[1] + heights[2]) / 3;
    if (heights[0] > 0) return add(whole, 0, area, 0);
    if (heights[2] <= 0) return add(0, -whole, 0, area);
    // The corner that is alone on its side.
    const bool is_top = heights[1] <= 0;
    const double alone = is_top ? heights[2] : heights[0];
    const double one = is_top ? heights[0] : heights[2];
    const double part = area * (alone / (alone - one)) * (alone / (alone - heights[1]));
    const double tip = part * std::abs(alone) / 3;
    if (is_top)
      add(tip, tip - whole, part, area - part);
    else
      add(whole + tip, tip, area - part, part);
  }
  [[nodiscard]] Volume total() {
    return {above_.total(), below_.total(), area_above_.total(), area_below_.total()};
  }

 private:
  void add(double above, double below, double area_above, double area_below) {
    above_.add(above);
    below_.add(below);
    area_above_.add(area_above);
    area_below_.add(area_below);
  }

  OrderlySum above_;
  OrderlySum below_;
  OrderlySum area_above_;
  OrderlySum area_below_;
};

/// The corners of a triangle, from its smallest.
std::array<Point, 3> corners_of(const Triangulation& mesh, TriangleId t) {
  std::array<Point, 3> corners{};
  for (unsigned i = 0; i < 3; ++i) corners[i] = mesh.point(mesh.from(Triangulation::edge(t, i)));
  std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
  return corners;
}

/// The triangles of which each is inside one of every field, and inside or outside of polygons.
class Cuts {
 public:
  void add(const Field& field) {
    const Triangulation& mesh = field.mesh();
    for (std::uint32_t i = 0; i < mesh.edge_bound(); ++i) {
      const EdgeId e(i);
      if (!mesh.is_triangle(Triangulation::triangle(e)) || mesh.twin(e) < e) continue;
      if (mesh.from(e) == Triangulation::infinite || mesh.to(e) == Triangulation::infinite)
        continue;
      ends_.push_back({mesh.point(mesh.from(e)), mesh.point(mesh.to(e))});
    }
  }
  void add(const overlay::MultiPolygon& polygons) {
    for (const overlay::Polygon& polygon : polygons) {
      rings_.push_back(polygon.outer);
      rings_.insert(rings_.end(), polygon.holes.begin(), polygon.holes.end());
    }
    has_polygons_ = true;
  }
  /// Calls visit(corners) for each triangle that is inside of the polygons, if any were added.
  template <class Visit>
  void for_each(Visit visit) {
    std::vector<cdt::Polyline> lines;
    for (const overlay::Ring& ring : rings_) lines.push_back({ring, cdt::closed});
    for (const auto& ends : ends_) lines.push_back({ends, cdt::open});
    Triangulation mesh;
    const std::vector<cdt::ConstraintId> ids = mesh.insert(lines);
    const std::vector<bool> is_inside = cdt::odd_parity(mesh, [&](cdt::ConstraintId c) {
      return std::binary_search(ids.begin(),
                                ids.begin() + static_cast<std::ptrdiff_t>(rings_.size()), c);
    });
    for (std::uint32_t i = 0; i < mesh.triangle_bound(); ++i) {
      const TriangleId t(i);
      if (mesh.is_triangle(t) && !mesh.is_infinite(t) && (!has_polygons_ || is_inside[i]))
        visit(corners_of(mesh, t));
    }
  }

 private:
  std::vector<std::array<Point, 2>> ends_;
  std::vector<overlay::Ring> rings_;
  bool has_polygons_ = false;
};

/// The heights of a field at the corners of a triangle that is inside one of its own.
std::optional<std::array<double, 3>> heights_at(const Field& field,
                                                const std::array<Point, 3>& corners) {
  const Point middle = centroid(corners[0], corners[1], corners[2]);
  const cdt::Location place = field.mesh().locate(middle);
  if (place.kind == cdt::Location::Kind::nowhere) return std::nullopt;
  const EdgeId e = place.kind == cdt::Location::Kind::edge ? field.seen_from(place.edge, Side::left)
                                                           : place.edge;
  if (!has_surface(field, Triangulation::triangle(e))) return std::nullopt;
  const Patch patch(field, Triangulation::triangle(e), Smoothness::linear);
  return std::array{patch.value(corners[0]), patch.value(corners[1]), patch.value(corners[2])};
}

}  // namespace

Volume volume(const Field& field, double level) {
  Prisms prisms;
  for (std::uint32_t i = 0; i < field.mesh().triangle_bound(); ++i) {
    const TriangleId t(i);
    if (!has_surface(field, t)) continue;
    prisms.add(corners_of(field.mesh(), t),
               {field.corner_value(Triangulation::edge(t, 0)) - level,
                field.corner_value(Triangulation::edge(t, 1)) - level,
                field.corner_value(Triangulation::edge(t, 2)) - level});
  }
  return prisms.total();
}

Volume volume(const Field& field, double level, const overlay::MultiPolygon& within) {
  Cuts cuts;
  cuts.add(field);
  cuts.add(within);
  Prisms prisms;
  cuts.for_each([&](const std::array<Point, 3>& corners) {
    if (const auto z = heights_at(field, corners))
      prisms.add(corners, {(*z)[0] - level, (*z)[1] - level, (*z)[2] - level});
  });
  return prisms.total();
}

namespace {

Volume volume_between_cut(const Field& upper, const Field& lower, Cuts cuts) {
  cuts.add(upper);
  cuts.add(lower);
  Prisms prisms;
  cuts.for_each([&](const std::array<Point, 3>& corners) {
    const auto high = heights_at(upper, corners);
    const auto low = heights_at(lower, corners);
    if (high && low)
      prisms.add(corners, {(*high)[0] - (*low)[0], (*high)[1] - (*low)[1], (*high)[2] - (*low)[2]});
  });
  return prisms.total();
}

}  // namespace

Volume volume_between(const Field& upper, const Field& lower) {
  return volume_between_cut(upper, lower, {});
}

Volume volume_between(const Field& upper, const Field& lower, const overlay::MultiPolygon& within) {
  Cuts cuts;
  cuts.add(within);
  return volume_between_cut(upper, lower, std::move(cuts));
}

std::vector<double> areas_by_slope(const Field& field, std::span<const double> bounds) {
  std::vector<OrderlySum> areas(bounds.size() + 1);
  for (std::uint32_t i = 0; i < field.mesh().triangle_bound(); ++i) {
    const TriangleId t(i);
    if (!has_surface(field, t)) continue;
    const std::array<Point, 3> corners = corners_of(field.mesh(), t);
    const Vector gradient = Patch(field, t, Smoothness::linear).gradient(corners[0]);
    const double slope = std::sqrt(dot(gradient, gradient));
    const auto group = std::upper_bound(bounds.begin(), bounds.end(), slope) - bounds.begin();
    areas[static_cast<std::size_t>(group)].add(
        cross(way(corners[0], corners[1]), way(corners[0], corners[2])) / 2);
  }
  std::vector<double> totals;
  for (OrderlySum& area : areas) totals.push_back(area.total());
  return totals;
}

}  // namespace loft::fields
