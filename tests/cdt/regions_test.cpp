// SPDX-License-Identifier: MIT
#include "cdt/regions.h"

#include <gtest/gtest.h>

#include "tests/cdt/constraints.h"

namespace loft::cdt {
namespace {

std::vector<Point> square(double half) {
  return {{-half, -half}, {half, -half}, {half, half}, {-half, half}};
}

std::uint32_t triangle_at(const Triangulation& mesh, Point p) {
  return Triangulation::triangle(mesh.locate(p).edge).index();
}

TEST(Regions, WindingCountsNestedSquaresWithTheirDirections) {
  Triangulation mesh;
  auto reversed = square(1);
  std::ranges::reverse(reversed);
  mesh.insert(square(3), closed);
  const auto middle = mesh.insert(square(2), closed);
  mesh.insert(reversed, closed);
  const auto winding = winding_numbers(mesh);
  EXPECT_EQ(winding[triangle_at(mesh, {9, 9})], 0);
  EXPECT_EQ(winding[triangle_at(mesh, {2.5, 0.1})], 1);
  EXPECT_EQ(winding[triangle_at(mesh, {1.5, 0.1})], 2);
  EXPECT_EQ(winding[triangle_at(mesh, {0.5, 0.1})], 1);

  const auto parity = odd_parity(mesh);
  EXPECT_TRUE(parity[triangle_at(mesh, {2.5, 0.1})]);
  EXPECT_FALSE(parity[triangle_at(mesh, {1.5, 0.1})]);
  EXPECT_TRUE(parity[triangle_at(mesh, {0.5, 0.1})]);

  const auto only_middle = odd_parity(mesh, [&](ConstraintId c) { return c == middle; });
  EXPECT_FALSE(only_middle[triangle_at(mesh, {2.5, 0.1})]);
  EXPECT_TRUE(only_middle[triangle_at(mesh, {0.5, 0.1})]);
}

TEST(Regions, OutAndBackEnclosesNothing) {
  Triangulation mesh;
  mesh.insert(std::vector<Point>{{0, 0}, {5, 0}, {5, 5}}, open);
  mesh.insert(std::vector<Point>{{1, 1}, {4, 2}}, closed);
  for (const int winding : winding_numbers(mesh, [](ConstraintId c) { return c.index() == 1; }))
    EXPECT_EQ(winding, 0);
}

/// Whether p is inside a polygon by the crossings of a ray: the oracle.
bool is_inside(const std::vector<Point>& polygon, Point p) {
  bool inside = false;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const Point a = polygon[i];
    const Point b = polygon[j];
    if ((a.y > p.y) != (b.y > p.y) && p.x < (b.x - a.x) * (p.y - a.y) / (b.y - a.y) + a.x)
      inside = !inside;
  }
  return inside;
}

TEST(Regions, ParityIsThatOfARayThroughEveryPolygon) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const auto polylines = random_polylines(seed, Places::decimals);
    Triangulation mesh;
    for (const OwnPolyline& polyline : polylines) mesh.insert(polyline.points, closed);
    const auto parity = odd_parity(mesh);
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> coordinate(-0.1, 1.1);
    for (int i = 0; i < 50; ++i) {
      const Point p{coordinate(random), coordinate(random)};
      const auto place = mesh.locate(p);
      if (place.kind != Location::Kind::triangle && place.kind != Location::Kind::outside) continue;
      bool expected = false;
      for (const OwnPolyline& polyline : polylines) expected ^= is_inside(polyline.points, p);
      EXPECT_EQ(parity[Triangulation::triangle(place.edge).index()], expected);
    }
  }
}

}  // namespace
}  // namespace loft::cdt
