// SPDX-License-Identifier: MIT
// Small cases that others stumbled over, and what becomes of starts and goals of every kind.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "paths/shortest.h"
#include "tests/overlay/boxes.h"

namespace loft::paths {
namespace {

using overlay::box;
using overlay::Expression;
using overlay::Overlay;
using overlay::Ring;

/// Starts, turns and ends.
std::vector<Point> stops(const Path& path) {
  std::vector<Point> points;
  for (const Piece& piece : path.pieces) {
    if (points.empty()) points.push_back(piece.from);
    points.push_back(piece.to);
  }
  return points;
}

/// A room with obstacles, and walls that are open lines.
class Hall {
 public:
  explicit Hall(const Ring& outline, std::span<const Ring> obstacles = {},
                std::span<const Ring> walls = {}) {
    overlay_.insert(room_, outline);
    for (const Ring& ring : obstacles) overlay_.insert(obstacle_, ring);
    for (const Ring& line : walls) overlay_.insert(wall_, line, overlay::open);
    space_.follow();
  }

  [[nodiscard]] Path find(Point from, Point to) const {
    return shortest_path(space_, {.from = from, .to = to});
  }
  [[nodiscard]] Status status(Point from, Point to) const { return find(from, to).status; }

 private:
  Overlay overlay_;
  LayerId room_ = overlay_.add_layer("room");
  LayerId obstacle_ = overlay_.add_layer("obstacles", overlay::FillRule::nonzero);
  LayerId wall_ = overlay_.add_layer("walls");
  FreeSpace space_{overlay_, Expression(room_) - obstacle_, std::array{wall_}};
};

// godotengine/godot#70823
TEST(PathCases, ARingAroundARoomHasTwoParts) {
  Overlay overlay;
  const LayerId rings = overlay.add_layer("rings");
  for (const double half : {500.0, 300.0, 10.0})
    overlay.insert(rings, box(-half, -half, half, half));
  const FreeSpace space(overlay, rings);
  EXPECT_EQ(overlay.area(overlay.watch(rings)).to_double(), 640'400);
  Workspace workspace;
  Path path;
  workspace.find(space, {.from = {-400, 0}, .to = {0, 0}}, path);
  EXPECT_EQ(path.status, Status::unreachable);
  EXPECT_EQ(workspace.expansions(), 0U);
  workspace.find(space, {.from = {-400, 0}, .to = {400, 0}}, path);
  ASSERT_EQ(path.status, Status::found);
  EXPECT_NEAR(path.length, 1232.4555320336758, 1e-12 * path.length);
}

// jannikmi/extremitypathfinder#84
TEST(PathCases, AnObstacleThatOverlapsANotchIsWalkedAround) {
  const Ring outline{{161, 47},  {247, 47}, {247, 7}, {361, 7},
                     {361, 441}, {7, 441},  {7, 7},   {161, 7}};
  const std::array obstacles{Ring{{272, 172},
                                  {272, 36},
                                  {136, 36},
                                  {136, 172},
                                  {155.6, 172},
                                  {155.6, 332.4},
                                  {252.4, 332.4},
                                  {252.4, 172}}};
  const Path path = Hall(outline, obstacles).find({50.004004, 44.004004}, {318.004004, 44.004004});
  ASSERT_EQ(path.status, Status::found);
  EXPECT_NEAR(path.length, 699.6837633713652, 1e-12 * path.length);
  EXPECT_EQ(stops(path),
            (std::vector<Point>{
                {50.004004, 44.004004}, {155.6, 332.4}, {252.4, 332.4}, {318.004004, 44.004004}}));
}

// frapa/nav2d#2
TEST(PathCases, InAConvexRoomTheWayIsStraight) {
  const Hall room({{105, 245}, {245, 105}, {755, 105}, {245, 895}, {105, 755}});
  const Point from{321.94381764911583, 311.00705914346884};
  const Point to{145.50164006384801, 335.0348767805669};
  const Path path = room.find(from, to);
  ASSERT_EQ(path.status, Status::found);
  EXPECT_EQ(stops(path), (std::vector<Point>{from, to}));
  EXPECT_NEAR(path.length, 178.07071081857572, 1e-12 * path.length);
}

// hxDaedalus#49, recastnavigation#226
TEST(PathCases, AGoalNearByOrStraightAheadIsReachedStraight) {
  const Hall room(box(0, 0, 400, 400));
  EXPECT_EQ(room.find({200, 200}, {203, 204}).length, 5);
  EXPECT_EQ(room.find({200, 200}, {200, 205}).length, 5);
  EXPECT_EQ(room.find({100, 200}, {300, 200}).pieces.size(), 1U);
  EXPECT_EQ(room.find({100, 200}, {300, 200}).length, 200);
  EXPECT_EQ(room.find({100, 20}, {100, 380}).length, 360);
}

// recastnavigation#226
TEST(PathCases, AGapIsPassedAsLongAsItHasWidth) {
  const auto between = [](double left, double right) {
    const std::array obstacles{box(0, 190, left, 210), box(right, 190, 400, 210)};
    return Hall(box(0, 0, 400, 400), obstacles).find({200, 100}, {200, 300});
  };
  EXPECT_EQ(between(199, 201).length, 200);
  EXPECT_EQ(between(200, std::nextafter(200, 201)).length, 200);
  EXPECT_EQ(between(200, 200).status, Status::unreachable);
}

TEST(PathCases, APassageWithoutWidthIsClosed) {
  const std::array obstacles{box(0, 0, 50, 50), box(50, 50, 100, 100)};
  EXPECT_EQ(Hall(box(0, 0, 100, 100), obstacles).status({75, 25}, {25, 75}), Status::unreachable);
  const std::array walls{Ring{{0, 50}, {50, 50}}, Ring{{50, 50}, {50, 0}}};
  EXPECT_EQ(Hall(box(0, 0, 100, 100), {}, walls).status({25, 25}, {75, 75}), Status::unreachable);
  const std::array apart{walls[0], Ring{{50, 49}, {50, 0}}};
  EXPECT_EQ(Hall(box(0, 0, 100, 100), {}, apart).status({25, 25}, {75, 75}), Status::found);
}

TEST(PathStatus, InsideAnObstacleAndOutsideOfEverythingIsBlocked) {
  const std::array obstacles{box(40, 40, 60, 60)};
  const Hall room(box(0, 0, 100, 100), obstacles);
  const Point free{20, 50};
  for (const Point blocked : {Point{50, 50}, Point{40.5, 59}, Point{-1, 50}, Point{1e70, -1e70}}) {
    EXPECT_EQ(room.status(blocked, free), Status::start_blocked) << blocked;
    EXPECT_EQ(room.status(free, blocked), Status::goal_blocked) << blocked;
    EXPECT_EQ(room.status(blocked, blocked), Status::start_blocked) << blocked;
    EXPECT_EQ(room.find(blocked, free).length, std::numeric_limits<double>::infinity());
    EXPECT_TRUE(room.find(blocked, free).pieces.empty());
  }
}

TEST(PathStatus, WhatIsNotFiniteIsBlocked) {
  const Hall room(box(0, 0, 100, 100));
  constexpr double infinity = std::numeric_limits<double>::infinity();
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  const Point free{20, 50};
  for (const double number : {infinity, -infinity, nothing})
    for (const Point blocked : {Point{number, 50}, Point{50, number}, Point{number, number}}) {
      EXPECT_EQ(room.status(blocked, free), Status::start_blocked) << blocked;
      EXPECT_EQ(room.status(free, blocked), Status::goal_blocked) << blocked;
    }
}

TEST(PathStatus, NothingIsFreeWhereNothingIs) {
  Overlay overlay;
  const LayerId room = overlay.add_layer("room");
  FreeSpace space(overlay, room);
  EXPECT_EQ(shortest_path(space, {.from = {1, 2}, .to = {3, 4}}).status, Status::start_blocked);
  overlay.insert(room, std::vector<Point>{{1, 2}});
  space.follow();
  EXPECT_EQ(shortest_path(space, {.from = {1, 2}, .to = {1, 2}}).status, Status::start_blocked);
}

TEST(PathStatus, EdgesAndVerticesOfObstaclesAreFree) {
  const std::array obstacles{box(40, 40, 60, 60)};
  const Hall room(box(0, 0, 100, 100), obstacles);
  EXPECT_EQ(room.find({40, 50}, {20, 50}).length, 20) << "edge";
  EXPECT_EQ(room.find({40, 50}, {60, 50}).length, 40) << "edge to edge";
  EXPECT_EQ(room.find({45, 40}, {55, 40}).length, 10) << "along an edge";
  EXPECT_EQ(room.find({40, 40}, {60, 60}).length, 40) << "vertex to vertex";
  EXPECT_EQ(room.find({40, 40}, {60, 40}).length, 20) << "vertex to vertex beside it";
  EXPECT_EQ(room.find({0, 0}, {0, 100}).length, 100) << "along the room";
  EXPECT_EQ(room.find({30, 40}, {70, 40}).pieces.size(), 1U) << "past an edge";
  EXPECT_EQ(room.find({0, 20}, {20, 0}).pieces.size(), 1U);
}

TEST(PathStatus, OnAWallIsOnBothSidesOfIt) {
  const std::array walls{Ring{{50, 0}, {50, 90}}};
  const Hall room(box(0, 0, 100, 100), {}, walls);
  EXPECT_EQ(room.find({50, 20}, {30, 20}).length, 20);
  EXPECT_EQ(room.find({50, 20}, {70, 20}).length, 20);
  EXPECT_EQ(room.find({30, 20}, {50, 20}).length, 20);
  EXPECT_EQ(room.find({70, 20}, {50, 20}).length, 20);
  EXPECT_EQ(room.find({50, 20}, {50, 80}).length, 60);
  EXPECT_EQ(room.find({50, 0}, {60, 0}).length, 10) << "where it touches the room";
  EXPECT_EQ(room.find({40, 90}, {60, 90}).length, 20) << "past its end";
  EXPECT_EQ(room.find({40, 90 - 75}, {60, 90}).pieces.size(), 2U) << "around its end";
}

TEST(PathStatus, ToWhereOneIsThereIsNoWayToGo) {
  const std::array obstacles{box(40, 40, 60, 60)};
  const std::array walls{Ring{{20, 0}, {20, 20}}};
  const Hall room(box(0, 0, 100, 100), obstacles, walls);
  for (const Point p :
       {Point{10, 10}, Point{40, 40}, Point{40, 50}, Point{20, 10}, Point{20, 20}}) {
    const Path path = room.find(p, p);
    EXPECT_EQ(path.status, Status::found) << p;
    EXPECT_EQ(path.length, 0) << p;
    EXPECT_TRUE(path.pieces.empty()) << p;
  }
}

}  // namespace
}  // namespace loft::paths
