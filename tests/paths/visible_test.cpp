// SPDX-License-Identifier: MIT
#include "paths/visible.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "cdt/predicates.h"
#include "overlay/distance.h"
#include "paths/distance.h"
#include "paths/shortest.h"
#include "tests/cdt/allocations.h"
#include "tests/paths/grid_room.h"

namespace loft::paths {
namespace {

using overlay::box;
using overlay::Overlay;
using overlay::Ring;

/// Whether the segments ab and cd have a point in common.
bool meet(Point a, Point b, Point c, Point d) {
  const auto is_beside = [](Point p, Point q, Point r) {
    return std::min(p.x, q.x) <= r.x && r.x <= std::max(p.x, q.x) && std::min(p.y, q.y) <= r.y &&
           r.y <= std::max(p.y, q.y);
  };
  const int abc = cdt::orient(a, b, c);
  const int abd = cdt::orient(a, b, d);
  const int cda = cdt::orient(c, d, a);
  const int cdb = cdt::orient(c, d, b);
  if (abc * abd < 0 && cda * cdb < 0) return true;
  return (abc == 0 && is_beside(a, b, c)) || (abd == 0 && is_beside(a, b, d)) ||
         (cda == 0 && is_beside(c, d, a)) || (cdb == 0 && is_beside(c, d, b));
}

/// sees() the slow way: triangles are joined where they share a side that can be crossed and has a
/// point in common with the segment.
bool sees_slowly(const FreeSpace& space, Point a, Point b) {
  const Triangulation& mesh = space.mesh();
  std::vector<std::uint32_t> parents(mesh.triangle_bound());
  std::iota(parents.begin(), parents.end(), 0U);
  const auto root = [&](std::uint32_t t) {
    while (parents[t] != t) t = parents[t];
    return t;
  };
  for (std::uint32_t i = 0; i < mesh.edge_bound(); ++i) {
    const EdgeId e(i);
    if (!mesh.is_triangle(Triangulation::triangle(e)) || space.beyond(e).is_none()) continue;
    if (!meet(a, b, mesh.point(mesh.from(e)), mesh.point(mesh.to(e)))) continue;
    parents[root(Triangulation::triangle(e).index())] =
        root(Triangulation::triangle(mesh.twin(e)).index());
  }
  std::vector<TriangleId> starts;
  std::vector<TriangleId> goals;
  space.triangles_at(a, starts);
  space.triangles_at(b, goals);
  for (const TriangleId start : starts)
    for (const TriangleId goal : goals)
      if (root(start.index()) == root(goal.index())) return true;
  return false;
}

/// A room, 10 by 10, with obstacles and walls.
struct Room {
  explicit Room(const std::vector<Ring>& obstacles,
                const std::vector<std::vector<Point>>& lines = {}) {
    overlay.insert(room, box(0, 0, 10, 10));
    for (const Ring& ring : obstacles) overlay.insert(boxes, ring);
    for (const std::vector<Point>& line : lines) overlay.insert(walls, line, overlay::open);
    space.follow();
  }

  Overlay overlay;
  LayerId room = overlay.add_layer("room");
  LayerId boxes = overlay.add_layer("boxes", overlay::FillRule::nonzero);
  LayerId walls = overlay.add_layer("walls");
  FreeSpace space{overlay, overlay::Expression(room) - boxes, std::vector{walls}};
};

TEST(Sees, AlongBordersAndPastCorners) {
  const Room room({box(4, 4, 6, 6)});
  EXPECT_TRUE(sees(room.space, {1, 4}, {9, 4})) << "along a side";
  EXPECT_TRUE(sees(room.space, {2, 6}, {6, 2})) << "past a corner";
  EXPECT_TRUE(sees(room.space, {0, 0}, {10, 0})) << "along the border of everything";
  EXPECT_FALSE(sees(room.space, {1, 5}, {9, 5}));
  EXPECT_FALSE(sees(room.space, {1, 5}, {5, 5})) << "into an obstacle";
  EXPECT_TRUE(sees(room.space, {1, 5}, {4, 5})) << "up to it";
  EXPECT_FALSE(sees(room.space, {4, 5}, {6, 5})) << "through it, from side to side";
  EXPECT_FALSE(sees(room.space, {4, 4}, {6, 6})) << "from corner to corner";
  EXPECT_FALSE(sees(room.space, {1, 1}, {11, 1})) << "out of everything";
  EXPECT_FALSE(sees(room.space, {11, 1}, {1, 1}));
  EXPECT_TRUE(sees(room.space, {3, 3}, {3, 3}));
  EXPECT_FALSE(sees(room.space, {5, 5}, {5, 5}));
}

TEST(Sees, NothingThroughAPassageWithoutWidth) {
  const Room touching({box(2, 2, 5, 5), box(5, 5, 8, 8)});
  EXPECT_FALSE(sees(touching.space, {4, 6}, {6, 4})) << "obstacles touch in a point";
  const Room side_by_side({box(2, 4, 5, 6), box(5, 4, 8, 6)});
  EXPECT_FALSE(sees(side_by_side.space, {5, 2}, {5, 8})) << "obstacles touch along a side";
  const Room wall({box(4, 0, 6, 5)}, {{{6, 5}, {6, 10}}});
  EXPECT_FALSE(sees(wall.space, {4, 5}, {8, 5})) << "a wall stands on the corner";
}

TEST(Sees, AlongAWallOnOneSideOfIt) {
  const std::vector<Point> wall{{2, 5}, {8, 5}};
  const std::vector<Point> left{{4, 5}, {4, 7}};
  const std::vector<Point> right{{6, 5}, {6, 3}};
  EXPECT_TRUE(sees(Room({}, {wall}).space, {0, 5}, {10, 5}));
  EXPECT_TRUE(sees(Room({}, {wall, left}).space, {0, 5}, {10, 5})) << "on the right";
  EXPECT_TRUE(sees(Room({}, {wall, right}).space, {0, 5}, {10, 5})) << "on the left";
  const Room both({}, {wall, left, right});
  EXPECT_FALSE(sees(both.space, {0, 5}, {10, 5})) << "it cannot change sides";
  EXPECT_TRUE(sees(both.space, {5, 5}, {10, 5})) << "it is on both sides of what it starts on";
  EXPECT_TRUE(sees(both.space, {0, 5}, {5, 5}));
}

TEST(Sees, ExactlyWhatAPathOfOnePieceLeadsTo) {
  Workspace workspace;
  Path path;
  for (unsigned seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    const double unit = seed % 3 == 0 ? 0.1 : 1;
    GridRoom scene(seed, 4 + static_cast<int>(seed % 7), unit);
    const FreeSpace space = scene.free_space();
    for (int i = 0; i < 300; ++i) {
      const Point a = scene.place();
      const Point b = i % 4 == 0 ? scene.any_place() : scene.place();
      workspace.find(space, {.from = a, .to = b}, path);
      const bool is_straight = path.status == Status::found && path.pieces.size() <= 1;
      const bool is_seen = sees(space, a, b);
      ASSERT_EQ(sees(space, b, a), is_seen) << a << " to " << b;
      ASSERT_EQ(sees_slowly(space, a, b), is_seen) << a << " to " << b;
      // Rounded, a way that turns by a hair may be as short.
      if (!is_straight && is_seen)
        ASSERT_DOUBLE_EQ(path.length, distance_between(a, b));
      else
        ASSERT_EQ(is_seen, is_straight) << a << " to " << b;
    }
  }
}

TEST(Sees, TakesNoMemory) {
  const Room room({box(4, 4, 6, 6)}, {{{0, 2}, {10, 2}}});
  const std::size_t before = cdt::allocation_count();
  EXPECT_TRUE(sees(room.space, {1, 4}, {9, 4}));
  EXPECT_FALSE(sees(room.space, {1, 4}, {9, 5}));
  EXPECT_TRUE(sees(room.space, {1, 4}, {1, 4}));
  EXPECT_TRUE(first_hit(room.space, {1, 2}, {9, 7}).has_value());
  EXPECT_EQ(cdt::allocation_count(), before);
}

TEST(FirstHit, IsTheEdgeInTheWay) {
  const Room room({box(4, 4, 6, 6)});
  const Triangulation& mesh = room.space.mesh();
  const auto hit = first_hit(room.space, {1, 4.5}, {2, 4.75});
  ASSERT_TRUE(hit.has_value());
  EXPECT_EQ(hit->place, (Point{4, 5.25}));
  EXPECT_DOUBLE_EQ(hit->distance, std::sqrt(9 + 0.5625));
  EXPECT_EQ(mesh.point(mesh.from(hit->edge)), (Point{4, 4})) << "what is free is on its left";
  EXPECT_EQ(mesh.point(mesh.to(hit->edge)), (Point{4, 6}));
  EXPECT_EQ(first_hit(room.space, {1, 4}, {2, 4})->place, (Point{10, 4})) << "along a side";
  EXPECT_EQ(first_hit(room.space, {2, 2}, {3, 3})->place, (Point{4, 4})) << "a corner";
  EXPECT_EQ(first_hit(room.space, {4, 5}, {5, 5})->place, (Point{4, 5})) << "it cannot leave";
  EXPECT_EQ(first_hit(room.space, {4, 4}, {5, 5})->distance, 0);
  EXPECT_EQ(first_hit(room.space, {10, 10}, {11, 12})->distance, 0);
  EXPECT_FALSE(first_hit(room.space, {5, 5}, {6, 5}).has_value());
  EXPECT_FALSE(first_hit(room.space, {11, 5}, {6, 5}).has_value());
  EXPECT_FALSE(first_hit(room.space, {1, 1}, {1, 1}).has_value());
}

/// Whether a place on the ray is not beyond its end. Exact.
bool is_up_to(const FreeSpace& space, const Hit& hit, Point from, Point place) {
  const Triangulation& mesh = space.mesh();
  const Point a = mesh.point(mesh.from(hit.edge));
  const Point b = mesh.point(mesh.to(hit.edge));
  if (place == from || hit.place == from) return place == from;
  if (hit.place != a && hit.place != b) return cdt::orient(a, b, place) >= 0;
  return hit.place == place || (from < place) == (place < hit.place);
}

TEST(FirstHit, IsAsFarAsOneSees) {
  for (unsigned seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    const int size = 4 + static_cast<int>(seed % 7);
    GridRoom scene(seed, size);
    const FreeSpace space = scene.free_space();
    for (int i = 0; i < 200; ++i) {
      const Point p = scene.place();
      const Point step{scene.number(6) - 3.0, scene.number(6) - 3.0};
      if (step == Point{}) continue;
      const auto hit = first_hit(space, p, {p.x + step.x, p.y + step.y});
      ASSERT_EQ(hit.has_value(), space.is_free(p));
      if (!hit) continue;
      EXPECT_FALSE(space.is_free(Triangulation::triangle(space.mesh().twin(hit->edge))) &&
                   !space.beyond(hit->edge).is_none());
      EXPECT_TRUE(space.is_free(Triangulation::triangle(hit->edge)));
      for (double t = 0; t < size; t += 0.25) {
        const Point q{p.x + t * step.x, p.y + t * step.y};
        ASSERT_EQ(sees(space, p, q), is_up_to(space, *hit, p, q))
            << p << " to " << q << ", hit " << hit->place;
      }
    }
  }
}

double area_of(const Ring& ring) {
  double sum = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point a = ring[i];
    const Point b = ring[(i + 1) % ring.size()];
    sum += (a.x - ring[0].x) * (b.y - ring[0].y) - (a.y - ring[0].y) * (b.x - ring[0].x);
  }
  return sum / 2;
}

/// Where a point is: +1 inside, 0 nearer than 1e-9 to the border, -1 outside.
int place_in(const Ring& ring, Point p) {
  bool is_inside = false;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point a = ring[i];
    const Point b = ring[(i + 1) % ring.size()];
    if (overlay::distance(p, overlay::nearest_on_segment(p, a, b)) < 1e-9) return 0;
    if ((a.y > p.y) != (b.y > p.y) && (cdt::orient(a, b, p) > 0) == (a.y < b.y))
      is_inside = !is_inside;
  }
  return is_inside ? 1 : -1;
}

/// Whether a segment touches a vertex on the way, so that it may lie in no ring though it is a way.
bool touches_vertex(const FreeSpace& space, Point a, Point b) {
  const Triangulation& mesh = space.mesh();
  for (std::uint32_t i = 1; i < mesh.vertex_bound(); ++i)
    if (mesh.is_vertex(VertexId(i)) && cdt::orient(a, b, mesh.point(VertexId(i))) == 0) return true;
  return false;
}

TEST(VisibleRegion, IsWhatOneSees) {
  for (unsigned seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    const int size = 4 + static_cast<int>(seed % 7);
    const double unit = seed % 3 == 0 ? 0.1 : 1;
    GridRoom scene(seed, size, unit);
    const FreeSpace space = scene.free_space();
    for (int i = 0; i < 20; ++i) {
      const Point p = i % 4 == 0 ? scene.any_place() : scene.place();
      const std::vector<Ring> rings = visible_region(space, p);
      ASSERT_EQ(rings.empty(), !space.is_free(p));
      for (const Ring& ring : rings) {
        EXPECT_GT(area_of(ring), 0);
        for (std::size_t k = 0; k < ring.size(); ++k) {
          const Point a = ring[k];
          const Point b = ring[(k + 1) % ring.size()];
          EXPECT_GE((a.x - p.x) * (b.y - p.y) - (a.y - p.y) * (b.x - p.x), -1e-12)
              << "star-shaped around " << p;
        }
      }
      for (double x = 0.25 * unit; x < size * unit; x += 0.5 * unit) {
        for (double y = 0.125 * unit; y < size * unit; y += 0.5 * unit) {
          int place = -1;
          for (const Ring& ring : rings) place = std::max(place, place_in(ring, {x, y}));
          if (place == 0) continue;
          if (place < 0 && touches_vertex(space, p, {x, y})) continue;
          ASSERT_EQ(sees(space, p, {x, y}), place > 0) << p << " to " << Point{x, y};
        }
      }
    }
  }
}

TEST(VisibleRegion, HasARingForEachSector) {
  const Room room({box(4, 4, 6, 6)}, {{{0, 2}, {10, 2}}, {{5, 7}, {5, 9}}});
  const auto on_wall = visible_region(room.space, {1, 2});
  ASSERT_EQ(on_wall.size(), 2U) << "both sides of a wall";
  EXPECT_EQ(on_wall[0], Ring({{0, 0}, {10, 0}, {10, 2}, {1, 2}, {0, 2}}));
  EXPECT_EQ(on_wall[1].front(), (Point{0, 2}));
  const Ring around{{0, 2}, {10, 2}, {10, 4}, {4, 4}, {4, 10}, {0, 10}};
  EXPECT_EQ(visible_region(room.space, {4, 4}), std::vector<Ring>{around}) << "a corner";
  const auto all_around = visible_region(room.space, {5, 9});
  ASSERT_EQ(all_around.size(), 1U) << "a wall's end";
  EXPECT_EQ(std::ranges::count(all_around[0], (Point{5, 9})), 0);
  EXPECT_TRUE(visible_region(room.space, {5, 5}).empty());
  EXPECT_TRUE(visible_region(room.space, {5, 11}).empty());
  const Room touching({box(2, 2, 5, 5), box(5, 5, 8, 8)});
  EXPECT_EQ(visible_region(touching.space, {5, 5}).size(), 2U) << "obstacles touch there";
}

TEST(VisibleRegion, IsTheSameAfterAnyEdits) {
  for (unsigned seed = 0; seed < 50; ++seed) {
    SCOPED_TRACE(seed);
    GridRoom scene(seed, 10);
    FreeSpace space = scene.free_space();
    std::vector<std::vector<Ring>> before;
    std::vector<Point> places;
    for (int i = 0; i < 30; ++i) places.push_back(scene.any_place());
    for (const Point p : places) before.push_back(visible_region(space, p));
    for (int i = 0; i < 10; ++i) {
      scene.insert_shape();
      scene.insert_wall();
    }
    EXPECT_THROW((void)visible_region(space, {1, 1}), std::logic_error);
    for (int i = 0; i < 20; ++i) {
      scene.overlay().remove(scene.rings().back());
      scene.rings().pop_back();
    }
    space.follow();
    for (std::size_t i = 0; i < places.size(); ++i)
      EXPECT_EQ(visible_region(space, places[i]), before[i]);
  }
}

}  // namespace
}  // namespace loft::paths
