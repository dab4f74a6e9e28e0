// SPDX-License-Identifier: MIT
#include "paths/shortest.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "tests/cdt/allocations.h"
#include "tests/overlay/boxes.h"

namespace loft::paths {
namespace {

using overlay::box;
using overlay::Overlay;

TEST(ShortestPath, GoesAroundABox) {
  Overlay overlay;
  const LayerId room = overlay.add_layer("room");
  const LayerId boxes = overlay.add_layer("boxes");
  overlay.insert(room, box(0, 0, 100, 100));
  overlay.insert(boxes, box(40, 20, 60, 90));
  const FreeSpace space(overlay, overlay::Expression(room) - boxes);
  const Path path = shortest_path(space, {.from = {20, 50}, .to = {80, 50}});
  ASSERT_EQ(path.status, Status::found);
  const std::vector<Piece> expected{{.from = {20, 50}, .to = {40, 20}},
                                    {.from = {40, 20}, .to = {60, 20}},
                                    {.from = {60, 20}, .to = {80, 50}}};
  EXPECT_EQ(path.pieces, expected);
  EXPECT_DOUBLE_EQ(path.length, 20 + 2 * std::sqrt(1300));
}

/// A corridor around a box, closed at its end where the goal is; which is nearer from outside.
TEST(ShortestPath, LeavesADeadEndForAGoalThatTouchesItFromOutside) {
  Overlay overlay;
  const LayerId room = overlay.add_layer("room");
  const LayerId boxes = overlay.add_layer("boxes");
  const LayerId walls = overlay.add_layer("walls");
  overlay.insert(room, box(0, 0, 100, 100));
  overlay.insert(boxes, box(20, 50, 40, 80));
  overlay.insert(walls, std::vector<Point>{{10, 50}, {10, 90}, {50, 90}, {50, 50}, {40, 50}},
                 overlay::open);
  const FreeSpace space(overlay, overlay::Expression(room) - boxes, std::vector{walls});
  const Query query{.from = {15, 70}, .to = {40, 50}};
  Workspace workspace;
  Path path;
  for (int i = 0; i < 100; ++i) {  // with time it knows where dead ends are
    workspace.find(space, query, path);
    ASSERT_EQ(path, shortest_path(space, query));
    ASSERT_DOUBLE_EQ(path.length, std::sqrt(425) + 20);
  }
}

/// A room with pillars behind a door is no dead end by its triangles: ways lead around in it.
TEST(ShortestPath, LeavesOutARoomWithOneDoorButForItsGoals) {
  Overlay overlay;
  const LayerId rooms = overlay.add_layer("rooms");
  const LayerId pillars = overlay.add_layer("pillars");
  overlay.insert(rooms, std::vector<Point>{{0, 0},
                                           {100, 0},
                                           {100, 40},
                                           {52, 40},
                                           {52, 50},
                                           {100, 50},
                                           {100, 100},
                                           {0, 100},
                                           {0, 50},
                                           {48, 50},
                                           {48, 40},
                                           {0, 40}});
  for (double x = 10; x < 90; x += 20) {
    overlay.insert(pillars, box(x, 10, x + 10, 20));
    overlay.insert(pillars, box(x, 70, x + 10, 80));
  }
  overlay.insert(pillars, box(60, 25, 70, 40));
  const FreeSpace space(overlay, overlay::Expression(rooms) - pillars);
  const Query below{.from = {2, 2}, .to = {98, 38}};
  const Query up{.from = {2, 2}, .to = {98, 98}};
  Workspace warm;
  Path path;
  for (int i = 0; i < 100; ++i) warm.find(space, up, path);
  for (const Query& query : {below, up, Query{.from = up.to, .to = up.from}}) {
    Workspace cold;
    Path same;
    cold.find(space, query, same);
    warm.find(space, query, path);
    EXPECT_EQ(path, same);
    EXPECT_LE(warm.expansions(), cold.expansions());
  }
  const Query across{.from = {2, 38}, .to = {98, 38}};  // past the door
  Workspace cold;
  cold.find(space, across, path);
  warm.find(space, across, path);
  EXPECT_LT(warm.expansions(), cold.expansions());
}

TEST(ShortestPath, AWorkspaceKnowsASpaceFromAnotherInItsPlace) {
  const auto box_at = [](Overlay& overlay, double x) {
    const LayerId room = overlay.add_layer("room");
    const LayerId boxes = overlay.add_layer("boxes");
    overlay.insert(room, box(0, 0, 100, 100));
    overlay.insert(boxes, box(x, 20, x + 20, 100));
    return overlay::Expression(room) - boxes;
  };
  Overlay one;
  Overlay other;
  Workspace workspace;
  Path path;
  std::optional<FreeSpace> space;
  space.emplace(one, box_at(one, 40));
  for (int i = 0; i < 100; ++i) workspace.find(*space, {.from = {20, 50}, .to = {80, 50}}, path);
  space.emplace(other, box_at(other, 10));
  const Query query{.from = {5, 50}, .to = {80, 50}};
  workspace.find(*space, query, path);
  EXPECT_EQ(path, shortest_path(*space, query));
}

TEST(ShortestPath, TakesNoMemoryOnceWarm) {
  Overlay overlay;
  const LayerId room = overlay.add_layer("room");
  const LayerId boxes = overlay.add_layer("boxes");
  overlay.insert(room, box(0, 0, 100, 100));
  for (int i = 0; i < 5; ++i) overlay.insert(boxes, box(10 + 18 * i, 20 + 7 * i, 16 + 18 * i, 60));
  FreeSpace space(overlay, overlay::Expression(room) - boxes);
  space.keep_gaps();
  Workspace workspace;
  Path path;
  const auto find_all = [&] {
    for (const double radius : {0.0, 2.0})
      for (int i = 0; i < 50; ++i)
        workspace.find(space, {{3, 2.0 * i}, {97, 98 - 1.9 * i}, radius}, path);
  };
  find_all();
  find_all();  // dead ends are known by now
  const std::size_t before = cdt::allocation_count();
  find_all();
  EXPECT_EQ(cdt::allocation_count(), before);
}

}  // namespace
}  // namespace loft::paths
