// SPDX-License-Identifier: MIT
#include "fields/isolines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "cdt/predicates.h"
#include "cdt/rounding.h"
#include "fields/level.h"
#include "overlay/validity.h"
#include "tests/fields/edited.h"

namespace loft::fields {
namespace {

using Points = std::vector<Point>;
using Doubles = std::vector<double>;

constexpr double infinity = std::numeric_limits<double>::infinity();

[[nodiscard]] Field peak() {
  Field field;
  for (const Point p : {Point{0, 0}, Point{4, 0}, Point{4, 4}, Point{0, 4}})
    field.insert(Sample{p, 0});
  field.insert(Sample{{2, 2}, 4});
  return field;
}

TEST(Isolines, CloseAroundAPeakWithWhatIsHigherOnTheLeft) {
  const std::vector<Isoline> lines = isolines(peak(), Doubles{2, 7});
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0],
            (Isoline{.level = 2, .is_closed = true, .points = {{1, 1}, {3, 1}, {3, 3}, {1, 3}}}));
}

TEST(Isolines, EndAtAWall) {
  Field field = peak();
  field.insert(Line{.points = Points{{2, 0}, {2, 4}},
                    .kind = LineKind::wall,
                    .left = Doubles{0, 0},
                    .right = Doubles{8, 8}});
  for (const Isoline& line : isolines(field, Doubles{2})) {
    EXPECT_FALSE(line.is_closed);
    const bool is_east = line.points[1].x > 2;
    for (const Point p : line.points) EXPECT_TRUE(is_east ? p.x >= 2 : p.x <= 2);
  }
}

TEST(Isolines, OfWhatIsExactlyAtALevelGoAroundIt) {
  Field field = peak();
  field.set_value(SampleId(4), 0);
  EXPECT_TRUE(isolines(field, Doubles{0}).empty());
  field.set_value(SampleId(4), -1);
  const std::vector<Isoline> lines = isolines(field, Doubles{0});
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0].points, (Points{{0, 0}, {0, 4}, {4, 4}, {4, 0}}));
}

[[nodiscard]] bool is_on_separator(const Field& field, Point p) {
  const Triangulation& mesh = field.mesh();
  for (std::uint32_t i = 0; i < mesh.edge_bound(); ++i) {
    const EdgeId e(i);
    if (!has_surface(field, Triangulation::triangle(e)) || !field.is_separating(e)) continue;
    if (cdt::distance_to_segment(mesh.point(mesh.from(e)), mesh.point(mesh.to(e)), p) < 1e-12)
      return true;
  }
  return false;
}

[[nodiscard]] bool crosses_separator(const Field& field, Point p, Point q) {
  // The ends are rounded to edges.
  const Point a{p.x + 1e-9 * (q.x - p.x), p.y + 1e-9 * (q.y - p.y)};
  const Point b{q.x + 1e-9 * (p.x - q.x), q.y + 1e-9 * (p.y - q.y)};
  const Triangulation& mesh = field.mesh();
  for (std::uint32_t i = 0; i < mesh.edge_bound(); ++i) {
    const EdgeId e(i);
    if (mesh.is_triangle(Triangulation::triangle(e)) && mesh.from(e) != Triangulation::infinite &&
        mesh.to(e) != Triangulation::infinite && field.is_separating(e) &&
        cdt::crosses(a, b, mesh.point(mesh.from(e)), mesh.point(mesh.to(e))))
      return true;
  }
  return false;
}

TEST(Isolines, LieAtTheirLevelAndStopAtWalls) {
  std::size_t closed = 0;
  std::size_t open = 0;
  for (std::uint64_t seed = 0; seed < fields_to_try(30); ++seed) {
    SCOPED_TRACE(seed);
    Edited edited(seed);
    for (int i = 0; i < 60; ++i) edited.edit();
    const Field& field = edited.field();
    for (const Isoline& line : isolines(field, Doubles{7.3, 20, 41.7})) {
      (line.is_closed ? closed : open) += 1;
      for (std::size_t i = 1; i < line.points.size(); ++i)
        EXPECT_FALSE(crosses_separator(field, line.points[i - 1], line.points[i]));
      if (!line.is_closed) {
        EXPECT_TRUE(is_on_separator(field, line.points.front())) << line.points.front();
        EXPECT_TRUE(is_on_separator(field, line.points.back())) << line.points.back();
      }
      for (std::size_t i = 1; i < line.points.size(); ++i) {
        const Point p = line.points[i - 1];
        const Point q = line.points[i];
        const Point middle{p.x + (q.x - p.x) / 2, p.y + (q.y - p.y) / 2};
        const auto value = field.value(middle, Smoothness::linear, Side::left, Outside::nearest);
        const auto slope = field.gradient(middle);
        if (!value || !slope) continue;
        EXPECT_NEAR(*value, line.level, 1e-12 * (64 + 16 * std::sqrt(dot(*slope, *slope))));
      }
    }
  }
  EXPECT_GT(closed, 10U);
  EXPECT_GT(open, 100U);
}

[[nodiscard]] bool is_inside(const overlay::MultiPolygon& polygons, Point p) {
  bool is_in = false;
  const auto count = [&](const overlay::Ring& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Point a = ring[i];
      const Point b = ring[(i + 1) % ring.size()];
      if ((a.y > p.y) != (b.y > p.y) && (cdt::orient(a, b, p) > 0) == (b.y > a.y)) is_in = !is_in;
    }
  };
  for (const overlay::Polygon& polygon : polygons) {
    count(polygon.outer);
    for (const overlay::Ring& hole : polygon.holes) count(hole);
  }
  return is_in;
}

TEST(Bands, AreWhereTheValuesAre) {
  for (std::uint64_t seed = 100; seed < 100 + fields_to_try(30); ++seed) {
    SCOPED_TRACE(seed);
    Edited edited(seed);
    for (int i = 0; i < 60; ++i) edited.edit();
    const Field& field = edited.field();
    const std::vector<Band> all = bands(field, Doubles{-infinity, 10, 20, 32.5, infinity});
    double area = 0;
    for (const Band& band : all) {
      EXPECT_TRUE(overlay::is_valid(band.polygons));
      area += overlay::area(band.polygons).to_double();
    }
    double expected = 0;
    const Triangulation& mesh = field.mesh();
    for (std::uint32_t i = 0; i < mesh.triangle_bound(); ++i) {
      const EdgeId e = Triangulation::edge(TriangleId(i));
      if (!has_surface(field, TriangleId(i))) continue;
      expected += cross(way(mesh.point(mesh.from(e)), mesh.point(mesh.to(e))),
                        way(mesh.point(mesh.from(e)), mesh.point(mesh.apex(e)))) /
                  2;
    }
    EXPECT_NEAR(area, expected, 1e-10);
    for (int i = 0; i < 100; ++i) {
      const Point p = edited.anywhere();
      const std::optional<double> value = field.value(p);
      for (const Band& band : all) {
        // Within rounding of a border either may be.
        if (value && std::min(std::abs(*value - band.low), std::abs(*value - band.high)) < 1e-9)
          continue;
        EXPECT_EQ(is_inside(band.polygons, p), value && band.low <= *value && *value < band.high)
            << p;
      }
    }
  }
}

}  // namespace
}  // namespace loft::fields
