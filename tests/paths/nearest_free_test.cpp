// SPDX-License-Identifier: MIT
#include "paths/nearest_free.h"

#include <gtest/gtest.h>

#include <limits>

#include "overlay/distance.h"
#include "tests/paths/grid_room.h"

namespace loft::paths {
namespace {

using overlay::box;
using overlay::Overlay;

/// The distance to the nearest triangle that is wanted, all being looked at; 0 if p is in one.
template <class IsWanted>
double distance_slowly(const FreeSpace& space, Point p, IsWanted is_wanted) {
  const Triangulation& mesh = space.mesh();
  std::vector<TriangleId> at;
  space.triangles_at(p, at);
  if (std::ranges::any_of(at, is_wanted)) return 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::uint32_t i = 0; i < mesh.edge_bound(); ++i) {
    const EdgeId e(i);
    const TriangleId t = Triangulation::triangle(e);
    if (!mesh.is_triangle(t) || !space.is_free(t) || !is_wanted(t)) continue;
    const Point place =
        overlay::nearest_on_segment(p, mesh.point(mesh.from(e)), mesh.point(mesh.to(e)));
    least = std::min(least, overlay::distance(p, place));
  }
  return least;
}

/// On the grid, or in and around the room.
Point any_place_of(GridRoom& scene) {
  return scene.number(1) == 0 ? scene.place() : scene.any_place();
}

TEST(NearestFree, IsOnTheNearestSideOfAnObstacle) {
  Overlay overlay;
  const LayerId room = overlay.add_layer("room");
  const LayerId boxes = overlay.add_layer("boxes");
  overlay.insert(room, box(0, 0, 10, 10));
  overlay.insert(boxes, box(2, 2, 8, 6));
  FreeSpace space(overlay, overlay::Expression(room) - boxes);
  EXPECT_EQ(nearest_free(space, {1, 1}), (Point{1, 1})) << "it is free";
  EXPECT_EQ(nearest_free(space, {2, 2}), (Point{2, 2})) << "on the border, too";
  EXPECT_EQ(nearest_free(space, {3, 4.5}), (Point{2, 4.5}));
  EXPECT_EQ(nearest_free(space, {5, 5.5}), (Point{5, 6}));
  EXPECT_EQ(nearest_free(space, {5, 4}), (Point{5, 2})) << "of two as near, the first";
  EXPECT_EQ(nearest_free(space, {-3, 4}), (Point{0, 4})) << "outside of everything";
  EXPECT_EQ(nearest_free(space, {14, 13}), (Point{10, 10}));
  EXPECT_FALSE(nearest_free(space, {std::numeric_limits<double>::infinity(), 0}).has_value());
  overlay.insert(boxes, box(0, 0, 10, 10));
  EXPECT_THROW((void)nearest_free(space, {1, 1}), std::logic_error);
}

TEST(NearestFree, IsNoneWhereNothingIsFree) {
  Overlay overlay;
  const LayerId room = overlay.add_layer("room");
  FreeSpace space(overlay, room);
  EXPECT_FALSE(nearest_free(space, {0, 0}).has_value());
  const LayerId boxes = overlay.add_layer("boxes");
  overlay.insert(boxes, box(2, 2, 8, 6));
  space.follow();
  EXPECT_FALSE(nearest_free(space, {0, 0}).has_value());
  EXPECT_FALSE(nearest_reachable(space, {0, 0}, {5, 5}).has_value());
}

TEST(NearestReachable, IsOnThisSideOfAWall) {
  Overlay overlay;
  const LayerId room = overlay.add_layer("room");
  const LayerId walls = overlay.add_layer("walls");
  overlay.insert(room, box(0, 0, 10, 10));
  overlay.insert(walls, std::vector<Point>{{4, 0}, {4, 10}}, overlay::open);
  const FreeSpace space(overlay, room, std::vector{walls});
  EXPECT_EQ(nearest_reachable(space, {1, 1}, {7, 3}), (Point{4, 3}));
  EXPECT_EQ(nearest_reachable(space, {1, 1}, {12, 3}), (Point{4, 3}));
  EXPECT_EQ(nearest_reachable(space, {1, 1}, {3, 3}), (Point{3, 3}));
  EXPECT_EQ(nearest_reachable(space, {9, 1}, {-1, -1}), (Point{4, 0}));
  EXPECT_EQ(nearest_reachable(space, {4, 1}, {7, 3}), (Point{7, 3})) << "from both sides of a wall";
  EXPECT_FALSE(nearest_reachable(space, {11, 1}, {7, 3}).has_value());
}

TEST(NearestFree, IsAsNearAsAnyAndFree) {
  for (unsigned seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    const double units[] = {1, 0.1, 1e-9 / 3, 7e8 / 3};
    GridRoom scene(seed, 4 + static_cast<int>(seed % 7), units[seed % 4]);
    const FreeSpace space = scene.free_space();
    for (int i = 0; i < 60; ++i) {
      const Point p = any_place_of(scene);
      const double least =
          distance_slowly(space, p, [&](TriangleId t) { return space.is_free(t); });
      const auto place = nearest_free(space, p);
      ASSERT_EQ(place.has_value(), std::isfinite(least));
      if (!place) continue;
      EXPECT_TRUE(space.is_free(*place)) << p;
      EXPECT_NEAR(overlay::distance(p, *place), least, 1e-14 * units[seed % 4]) << p;
      EXPECT_EQ(*place == p, space.is_free(p));
    }
  }
}

TEST(NearestReachable, IsAsNearAsAnyAndReachable) {
  for (unsigned seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    const double units[] = {1, 0.1, 1e-9 / 3, 7e8 / 3};
    GridRoom scene(seed, 4 + static_cast<int>(seed % 7), units[seed % 4]);
    const FreeSpace space = scene.free_space();
    for (int i = 0; i < 60; ++i) {
      const Point from = scene.place();
      const Point p = any_place_of(scene);
      const auto place = nearest_reachable(space, from, p);
      ASSERT_EQ(place.has_value(), space.is_free(from));
      if (!place) continue;
      std::vector<TriangleId> starts;
      space.triangles_at(from, starts);
      const double least = distance_slowly(space, p, [&](TriangleId t) {
        return std::ranges::any_of(
            starts, [&](TriangleId start) { return space.component(start) == space.component(t); });
      });
      EXPECT_TRUE(space.is_reachable(from, *place)) << from << " to " << p;
      EXPECT_NEAR(overlay::distance(p, *place), least, 1e-14 * units[seed % 4])
          << from << " to " << p;
      EXPECT_EQ(*place == p, space.is_reachable(from, p));
    }
  }
}

TEST(NearestFree, IsTheSameAfterAnyEdits) {
  for (unsigned seed = 0; seed < 50; ++seed) {
    SCOPED_TRACE(seed);
    GridRoom scene(seed, 10, seed % 2 == 0 ? 0.1 : 1);
    FreeSpace space = scene.free_space();
    std::vector<Point> places;
    for (int i = 0; i < 100; ++i) places.push_back(any_place_of(scene));
    std::vector<std::optional<Point>> before;
    for (const Point p : places) before.push_back(nearest_free(space, p));
    for (int i = 0; i < 10; ++i) scene.insert_shape();
    for (int i = 0; i < 10; ++i) {
      scene.overlay().remove(scene.rings().back());
      scene.rings().pop_back();
    }
    space.follow();
    for (std::size_t i = 0; i < places.size(); ++i)
      EXPECT_EQ(nearest_free(space, places[i]), before[i]);
  }
}

}  // namespace
}  // namespace loft::paths
