// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "paths/clearance.h"
#include "paths/exact_distance.h"
#include "paths/shortest.h"
#include "tests/cases.h"
#include "tests/overlay/boxes.h"
#include "tests/paths/grown.h"

namespace loft::paths {
namespace {

using overlay::box;
using overlay::Overlay;

[[nodiscard]] double length_of(Point a, Point b) {
  return std::sqrt((a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y));
}

/// How far a point is from the nearest thing that blocks the way, seen or not.
[[nodiscard]] double nearest(const FreeSpace& space, Point p) {
  const Triangulation& mesh = space.mesh();
  double least = 1e300;
  for (std::uint32_t i = 0; i < mesh.edge_bound(); ++i) {
    const EdgeId e(i);
    if (!mesh.is_triangle(Triangulation::triangle(e))) continue;
    if (!space.is_free(Triangulation::triangle(e)) || !space.beyond(e).is_none()) continue;
    const Point a = mesh.point(mesh.from(e));
    const Point b = mesh.point(mesh.to(e));
    const double x = b.x - a.x;
    const double y = b.y - a.y;
    const double t = std::clamp(((p.x - a.x) * x + (p.y - a.y) * y) / (x * x + y * y), 0.0, 1.0);
    least = std::min(least, length_of(p, {a.x + t * x, a.y + t * y}));
  }
  return least;
}

/// Points along a path.
[[nodiscard]] std::vector<Point> samples(const Path& path) {
  std::vector<Point> result;
  constexpr int steps = 40;
  for (const Piece& piece : path.pieces) {
    for (int i = 0; i <= steps; ++i) {
      const double t = static_cast<double>(i) / steps;
      Point p{piece.from.x + t * (piece.to.x - piece.from.x),
              piece.from.y + t * (piece.to.y - piece.from.y)};
      if (piece.turn != Turn::straight) {
        const double radius = length_of(piece.from, piece.centre);
        const double here = length_of(p, piece.centre);
        if (here == 0) continue;
        p = {piece.centre.x + (p.x - piece.centre.x) * radius / here,
             piece.centre.y + (p.y - piece.centre.y) * radius / here};
      }
      result.push_back(p);
    }
  }
  return result;
}

/// A room with boxes, slanted triangles and walls.
struct Clutter {
  Overlay overlay;
  LayerId room = overlay.add_layer("room");
  LayerId things = overlay.add_layer("things", overlay::FillRule::nonzero);
  LayerId walls = overlay.add_layer("walls");
  std::mt19937 random;

  explicit Clutter(unsigned seed, int count) : random(seed) {
    overlay.insert(room, box(0, 0, 100, 100));
    for (int i = 0; i < count; ++i) add();
  }
  [[nodiscard]] double number(double low, double high) {
    return std::uniform_real_distribution<>(low, high)(random);
  }
  void add() {
    const Point at{number(0, 100), number(0, 100)};
    const double size = number(1, 12);
    switch (random() % 3) {
      case 0: {
        const Point to{at.x + number(-20, 20), at.y + number(-20, 20)};
        overlay.insert(walls, std::vector<Point>{at, to}, overlay::open);
        break;
      }
      case 1:
        overlay.insert(things, box(at.x, at.y, at.x + size, at.y + number(1, 12)));
        break;
      default: {
        std::vector<Point> ring;
        const double turn = number(0, 6.28);
        const int corners = 3 + static_cast<int>(random() % 4);
        for (int k = 0; k < corners; ++k)
          ring.push_back({at.x + size * std::cos(turn + 6.283185307179586 * k / corners),
                          at.y + size * std::sin(turn + 6.283185307179586 * k / corners)});
        overlay.insert(things, ring);
      }
    }
  }
  [[nodiscard]] overlay::Expression free() const { return overlay::Expression(room) - things; }
};

TEST(Radius, AgreesWithGrownObstacles) {
  int undecided = 0;
  int found = 0;
  int none = 0;
  const char* const more = std::getenv("LOFT_SOAK_DISCS");
  const unsigned scenes =
      more == nullptr ? unsigned{cases(12)} : static_cast<unsigned>(std::atoi(more));
  for (unsigned seed = 0; seed < scenes; ++seed) {
    SCOPED_TRACE(seed);
    Clutter scene(seed, 10 + static_cast<int>(seed % 5) * 8);
    FreeSpace space(scene.overlay, scene.free(), std::vector{scene.walls});
    space.keep_gaps();
    Workspace workspace;
    for (const double radius : {0.25, 0.7, 1.3, 2.0, 3.1, 4.5}) {
      SCOPED_TRACE(radius);
      const Grown outside(space, radius, 96, true);
      const Grown inside(space, radius, 96, false);
      for (int q = 0; q < 12; ++q) {
        const Query query{.from = {scene.number(0, 100), scene.number(0, 100)},
                          .to = {scene.number(0, 100), scene.number(0, 100)},
                          .radius = radius};
        std::ostringstream where;
        where.precision(17);
        where << "from " << query.from << " to " << query.to;
        SCOPED_TRACE(where.str());
        Path path;
        workspace.find(space, query, path);
        const Path most = shortest_path(outside.space(), {.from = query.from, .to = query.to});
        const Path least = shortest_path(inside.space(), {.from = query.from, .to = query.to});
        if (most.status == Status::found) {
          EXPECT_EQ(path.status, Status::found);
        }
        if (least.status != Status::found) {
          EXPECT_NE(path.status, Status::found);
        }
        if (most.status != least.status) ++undecided;
        if (path.status != Status::found) {
          EXPECT_EQ(path.pieces.size(), 0U);
          if (most.status == least.status) {
            EXPECT_EQ(path.status, most.status);
          }
          ++none;
          continue;
        }
        ++found;
        EXPECT_LE(path.length, most.length * (1 + 1e-9));
        EXPECT_GE(path.length, least.length * (1 - 1e-9));
        double at_least = 1e300;
        for (const Point& p : samples(path)) at_least = std::min(at_least, nearest(space, p));
        EXPECT_GE(at_least, radius * (1 - 1e-9));
        if (testing::Test::HasFailure() && more == nullptr) return;
      }
    }
  }
  std::printf("found %d, none %d, undecided %d\n", found, none, undecided);
}

TEST(Radius, AGapAsWideAsTheDiscIsPassed) {
  const double above = 1 + 0x1p-40;
  // Turned by a rational angle, so that widths of gaps are no coordinates.
  for (const auto& [cosine, sine] : {std::pair{1.0, 0.0}, std::pair{0.0, 1.0}}) {
    const auto turned = [&](overlay::Ring ring) {
      for (Point& p : ring) p = {cosine * p.x - sine * p.y, sine * p.x + cosine * p.y};
      return ring;
    };
    Overlay overlay;
    const LayerId room = overlay.add_layer("room");
    const LayerId boxes = overlay.add_layer("boxes");
    overlay.insert(room, turned(box(0, 0, 400, 400)));
    overlay.insert(boxes, turned(box(0, 190, 199, 210)));
    overlay.insert(boxes, turned(box(201, 190, 400, 210)));
    FreeSpace space(overlay, overlay::Expression(room) - boxes);
    space.keep_gaps();
    const auto at = [&](double x, double y) { return turned({{x, y}})[0]; };
    const Query query{.from = at(200, 100), .to = at(200, 300), .radius = 1};
    const Path path = shortest_path(space, query);
    ASSERT_EQ(path.status, Status::found);
    EXPECT_NEAR(path.length, 200, 1e-9);
    EXPECT_EQ(shortest_path(space, {query.from, query.to, above}).status, Status::unreachable);
    EXPECT_EQ(widest(space, query.from, query.to), 1);
  }
}

TEST(Radius, ASlantedGapIsAsWideAsItIs) {
  // A corner 5 away from a side with the direction (3, 4).
  Overlay overlay;
  const LayerId room = overlay.add_layer("room");
  const LayerId things = overlay.add_layer("things");
  overlay.insert(room, box(-100, -100, 100, 100));
  overlay.insert(things, overlay::Ring{{-60, -80}, {75, 100}, {-60, 100}});
  overlay.insert(things, overlay::Ring{{4, -3}, {100, -3}, {100, -90}});
  FreeSpace space(overlay, overlay::Expression(room) - things);
  space.keep_gaps();
  const Query query{.from = {70, 50}, .to = {-50, -90}, .radius = 2.5};
  EXPECT_EQ(shortest_path(space, query).status, Status::found);
  EXPECT_EQ(shortest_path(space, {query.from, query.to, 2.5 * (1 + 0x1p-50)}).status,
            Status::unreachable);
  EXPECT_EQ(widest(space, query.from, query.to), 2.5);
}

TEST(Radius, StartsAndGoalsNearWalls) {
  Overlay overlay;
  const LayerId room = overlay.add_layer("room");
  overlay.insert(room, box(0, 0, 400, 400));
  FreeSpace space(overlay, room);
  EXPECT_THROW((void)shortest_path(space, {{200, 200}, {205, 200}, 10}), std::logic_error);
  space.keep_gaps();
  const auto find = [&](Point from, Point to, double radius) {
    return shortest_path(space, {from, to, radius});
  };
  EXPECT_EQ(find({200, 200}, {205, 200}, 10).length, 5) << "nearer than the radius";
  EXPECT_EQ(find({200, 100}, {200, 300}, 10).length, 200);
  EXPECT_EQ(find({200, 200}, {200, 200}, 10).length, 0);
  EXPECT_EQ(find({5, 200}, {200, 200}, 10).status, Status::start_blocked);
  EXPECT_EQ(find({200, 200}, {200, 395}, 10).status, Status::goal_blocked);
  EXPECT_EQ(find({10, 200}, {390, 200}, 10).length, 380) << "touching";
  EXPECT_EQ(find({500, 200}, {200, 200}, 10).status, Status::start_blocked);
  EXPECT_THROW((void)find({200, 200}, {205, 200}, -1), std::invalid_argument);
  EXPECT_THROW((void)find({200, 200}, {205, 200}, std::nan("")), std::invalid_argument);
}

TEST(Radius, ClearanceAndTheWidestWay) {
  int joined = 0;
  for (unsigned seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    Clutter scene(seed, 20);
    FreeSpace space(scene.overlay, scene.free(), std::vector{scene.walls});
    space.keep_gaps();
    for (int q = 0; q < 20; ++q) {
      const Point from{scene.number(0, 100), scene.number(0, 100)};
      const Point to{scene.number(0, 100), scene.number(0, 100)};
      const double room = clearance(space, from);
      if (space.is_free(from)) {
        EXPECT_NEAR(room, nearest(space, from), 1e-9);
        EXPECT_TRUE(is_clear(space, from, room * (1 - 1e-12)));
        EXPECT_FALSE(is_clear(space, from, room * (1 + 1e-12)));
      } else {
        EXPECT_EQ(room, 0);
      }
      const double most = widest(space, from, to);
      EXPECT_EQ(most < 0, !space.is_reachable(from, to));
      if (most <= 0) continue;
      ++joined;
      EXPECT_EQ(shortest_path(space, {from, to, most}).status, Status::found);
      EXPECT_NE(shortest_path(space, {from, to, std::nextafter(most, 1e9)}).status, Status::found);
    }
  }
  EXPECT_GT(joined, 50);
}

TEST(Radius, LongerForALargerDiscAndTheSameBothWays) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    SCOPED_TRACE(seed);
    Clutter scene(seed, 25);
    FreeSpace space(scene.overlay, scene.free(), std::vector{scene.walls});
    space.keep_gaps();
    for (int q = 0; q < 20; ++q) {
      const Point from{scene.number(0, 100), scene.number(0, 100)};
      const Point to{scene.number(0, 100), scene.number(0, 100)};
      double before = shortest_path(space, {from, to}).length;
      for (const double radius : {1e-9, 0.3, 1.0, 2.0, 4.0}) {
        const Path path = shortest_path(space, {from, to, radius});
        const Path back = shortest_path(space, {to, from, radius});
        std::ostringstream where;
        where.precision(17);
        where << "from " << from << " to " << to << " radius " << radius;
        SCOPED_TRACE(where.str());
        if (path.status != Status::found) break;
        EXPECT_NEAR(back.length, path.length, 1e-11 * path.length);
        EXPECT_GE(path.length, before * (1 - 1e-11));
        if (radius == 1e-9) {
          EXPECT_NEAR(path.length, before, 1e-6);
        }
        before = path.length;
      }
    }
  }
}

TEST(Radius, ACornerHasAFootOnlyWhereItsWallsDoNotComeNearer) {
  Overlay overlay;
  const LayerId room = overlay.add_layer("room");
  const LayerId things = overlay.add_layer("things");
  overlay.insert(room, box(0, 0, 100, 100));
  overlay.insert(things, std::vector<Point>{{50, 30}, {70, 50}, {50, 70}, {30, 50}});
  FreeSpace space(overlay, overlay::Expression(room) - things);
  space.keep_gaps();
  const Gaps& gaps = *space.gaps();
  std::vector<Point> feet;
  for (std::uint32_t v = 1; v < gaps.mesh().vertex_bound(); ++v)
    if (gaps.is_foot(VertexId(v))) feet.push_back(gaps.mesh().point(VertexId(v)));
  std::ranges::sort(feet);
  EXPECT_EQ(feet, (std::vector<Point>{{0, 50}, {50, 0}, {50, 100}, {100, 50}}));
  EXPECT_EQ(shortest_path(space, {{30, 20}, {80, 80}, 15}).status, Status::found);
  EXPECT_NE(shortest_path(space, {{30, 20}, {80, 80}, std::nextafter(15, 16)}).status,
            Status::found);
}

/// LOFT_SOAK_DISCS for the long run.
TEST(Radius, TheSameAsAFreshBuildAfterMoves) {
  const char* const more = std::getenv("LOFT_SOAK_DISCS");
  const std::uint64_t seeds = more != nullptr ? std::strtoull(more, nullptr, 10) : 6;
  for (unsigned seed = 0; seed < seeds; ++seed) {
    SCOPED_TRACE(seed);
    Clutter scene(seed, 25);
    FreeSpace space(scene.overlay, scene.free(), std::vector{scene.walls});
    space.keep_gaps();
    Workspace workspace;
    for (int move = 0; move < 60; ++move) {
      const LayerId layer = scene.random() % 3 == 0 ? scene.walls : scene.things;
      const auto rings = scene.overlay.rings(layer);
      if (rings.empty()) continue;
      const auto ring = rings[scene.random() % rings.size()];
      scene.overlay.translate(ring, {scene.number(-15, 15), scene.number(-15, 15)});
      space.follow();
      FreeSpace fresh(scene.overlay, scene.free(), std::vector{scene.walls});
      fresh.keep_gaps();
      for (const double radius : {0.3, 1.0, 2.5}) {
        const Query query{.from = {scene.number(0, 100), scene.number(0, 100)},
                          .to = {scene.number(0, 100), scene.number(0, 100)},
                          .radius = radius};
        Path path;
        workspace.find(space, query, path);
        EXPECT_EQ(path, shortest_path(fresh, query));
      }
      EXPECT_EQ(widest(space, {50, 50}, {10, 10}), widest(fresh, {50, 50}, {10, 10}));
    }
  }
}

}  // namespace
}  // namespace loft::paths
