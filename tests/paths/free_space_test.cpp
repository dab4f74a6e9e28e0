// SPDX-License-Identifier: MIT
#include "paths/free_space.h"

#include <gtest/gtest.h>

#include <map>
#include <random>

#include "paths/clearance.h"
#include "tests/overlay/boxes.h"

namespace loft::paths {
namespace {

using overlay::box;
using overlay::Overlay;

/// Triangles with the same component are joined in `space` if and only if they are in `fresh`.
void expect_same_components(const FreeSpace& space, const FreeSpace& fresh) {
  std::map<std::uint32_t, std::uint32_t> there;
  std::map<std::uint32_t, std::uint32_t> back;
  const Triangulation& mesh = space.mesh();
  for (std::uint32_t i = 0; i < mesh.triangle_bound(); ++i) {
    const TriangleId t(i);
    if (!mesh.is_triangle(t)) continue;
    for (unsigned corner = 0; corner < 3; ++corner) {
      const EdgeId e = Triangulation::edge(t, corner);
      ASSERT_EQ(space.beyond(e), fresh.beyond(e));
      ASSERT_EQ(space.corner(e), fresh.corner(e));
    }
    ASSERT_EQ(there.try_emplace(space.component(t), fresh.component(t)).first->second,
              fresh.component(t));
    ASSERT_EQ(back.try_emplace(fresh.component(t), space.component(t)).first->second,
              space.component(t));
  }
}

TEST(FreeSpace, AWallCutsARoomInTwo) {
  Overlay overlay;
  const LayerId room = overlay.add_layer("room");
  const LayerId walls = overlay.add_layer("walls");
  overlay.insert(room, box(0, 0, 10, 10));
  FreeSpace space(overlay, room, std::vector{walls});
  EXPECT_TRUE(space.is_reachable({1, 5}, {9, 5}));
  const auto wall = overlay.insert(walls, std::vector<Point>{{5, 0}, {5, 10}}, overlay::open);
  EXPECT_TRUE(space.is_stale());
  space.follow();
  EXPECT_FALSE(space.is_reachable({1, 5}, {9, 5}));
  EXPECT_TRUE(space.is_reachable({5, 5}, {9, 5})) << "on the wall is on both sides of it";
  overlay.move(wall, std::vector<Point>{{5, 0}, {5, 9.5}});
  space.follow();
  EXPECT_TRUE(space.is_reachable({1, 5}, {9, 5}));
  EXPECT_FALSE(space.is_free(Point{10.5, 5}));
}

TEST(FreeSpace, ComponentsAreThoseOfAFreshBuildAfterAnyEdits) {
  for (unsigned seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const auto number = [&](double most) {
      return std::uniform_real_distribution<>(0, most)(random);
    };
    Overlay overlay;
    const LayerId room = overlay.add_layer("room");
    const LayerId boxes = overlay.add_layer("boxes", overlay::FillRule::nonzero);
    const LayerId walls = overlay.add_layer("walls");
    overlay.insert(room, box(0, 0, 100, 100));
    const std::vector walling{walls};
    const auto free = overlay::Expression(room) - boxes;
    FreeSpace space(overlay, free, walling);
    std::vector<overlay::RingId> rings;
    const auto line = [&] {
      std::vector<Point> points{{number(100), number(100)}};
      points.push_back({points[0].x + number(60) - 30, points[0].y + number(60) - 30});
      return points;
    };
    const auto shape = [&] {
      const double x = number(100);
      const double y = number(100);
      return box(x, y, x + 1 + number(30), y + 1 + number(30));
    };
    for (std::size_t i = 0; i < 60; ++i) {
      const bool is_wall = random() % 2 == 0;
      rings.push_back(is_wall ? overlay.insert(walls, line(), overlay::open)
                              : overlay.insert(boxes, shape()));
      space.follow();
      if (rings.size() > 25) {
        overlay.remove(rings[i % 20]);
        space.follow();
        rings.erase(rings.begin() + static_cast<std::ptrdiff_t>(i % 20));
      }
      const auto moved = rings[random() % rings.size()];
      overlay.translate(moved, {number(40) - 20, number(40) - 20});
      space.follow();
      // Several holes, far from one another.
      overlay.begin_batch();
      for (std::size_t k = 0; k < i % 4; ++k)
        overlay.translate(rings[random() % rings.size()], {number(160) - 80, number(160) - 80});
      overlay.end_batch();
      space.follow();
      const FreeSpace fresh(overlay, free, walling);
      ASSERT_NO_FATAL_FAILURE(expect_same_components(space, fresh));
    }
  }
}

TEST(FreeSpace, StepsLeaveAllAsAFreshBuild) {
  std::mt19937 random(3);
  const auto number = [&](double most) {
    return std::uniform_real_distribution<>(0, most)(random);
  };
  Overlay overlay;
  const LayerId room = overlay.add_layer("room");
  const LayerId boxes = overlay.add_layer("boxes", overlay::FillRule::nonzero);
  overlay.insert(room, box(0, 0, 100, 100));
  std::vector<overlay::RingId> rings;
  for (int i = 0; i < 40; ++i) {
    const double x = number(95);
    const double y = number(95);
    rings.push_back(overlay.insert(boxes, box(x, y, x + 1 + number(9), y + 1 + number(9))));
  }
  const auto free = overlay::Expression(room) - boxes;
  FreeSpace space(overlay, free);
  space.keep_gaps();
  std::size_t moved = 0;
  for (int i = 0; i < 300; ++i) {
    const double far = i % 3 == 0 ? 1e-3 : 0.5;
    overlay.translate(rings[random() % rings.size()],
                      {number(far) - far / 2, number(far) - far / 2});
    moved += overlay.triangulation().changes().moved.size();
    space.follow();
    FreeSpace fresh(overlay, free);
    ASSERT_NO_FATAL_FAILURE(expect_same_components(space, fresh));
    if (i % 20 != 0) continue;
    fresh.keep_gaps();
    EXPECT_EQ(widest(space, {0, 0}, {100, 100}), widest(fresh, {0, 0}, {100, 100}));
  }
  EXPECT_GT(moved, 0U);
}

}  // namespace
}  // namespace loft::paths
