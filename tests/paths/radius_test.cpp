// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "paths/clearance.h"
#include "paths/exact_distance.h"
#include "paths/shortest.h"
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
struct Scene {
  Overlay overlay;
  LayerId room = overlay.add_layer("room");
  LayerId things = overlay.add_layer("things", overlay::FillRule::nonzero);
  LayerId walls = overlay.add_layer("walls");
  std::mt19937 random;

  explicit Scene(unsigned seed, int count) : random(seed) {
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
  const char* const more = std::getenv("LOFT_SOAK_SCENES");
  const unsigned scenes = more == nullptr ? 12 : static_cast<unsigned>(std::atoi(more));
  for (unsigned seed = 0; seed < scenes; ++seed) {
    SCOPED_TRACE(seed);
    Scene scene(seed, 10 + static_cast<int>(seed % 5) * 8);
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

}  // namespace
}  // namespace loft::paths
