// SPDX-License-Identifier: MIT
#include "paths/planner.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "paths/cell_grid.h"
#include "paths/visible.h"
#include "tests/overlay/boxes.h"

namespace loft::paths {
namespace {

using overlay::box;
using overlay::Overlay;
using testing::ElementsAre;
using testing::IsEmpty;

[[nodiscard]] std::vector<PathId> named(std::span<const PathId> paths) {
  return {paths.begin(), paths.end()};
}

/// A room with a box in it.
struct Planned {
  Overlay overlay;
  LayerId room = overlay.add_layer("room");
  LayerId boxes = overlay.add_layer("boxes");
  LayerId walls = overlay.add_layer("walls");
  overlay::RingId frame = overlay.insert(room, box(0, 0, 100, 100));
  overlay::RingId thing = overlay.insert(boxes, box(80, 80, 90, 90));
  FreeSpace space{overlay, overlay::Expression(room) - boxes, std::vector{walls}};
  Planner planner{space};
};

TEST(Planner, NamesWhatABoxBreaksAndFindsItAnew) {
  Planned here;
  const PathId across = here.planner.keep({.from = {10, 50}, .to = {90, 50}});
  const PathId below = here.planner.keep({.from = {10, 10}, .to = {90, 10}});
  EXPECT_EQ(here.planner.path(across).length, 80);
  EXPECT_EQ(here.planner.path(below).length, 80);
  EXPECT_THAT(named(here.planner.after_edit()), IsEmpty());
  here.overlay.move(here.thing, box(40, 40, 60, 60));
  here.space.follow();
  EXPECT_THAT(named(here.planner.after_edit()), ElementsAre(across));
  EXPECT_GT(here.planner.path(across).length, 80);
  here.overlay.move(here.thing, box(80, 80, 90, 90));
  here.space.follow();
  EXPECT_THAT(named(here.planner.after_edit()), IsEmpty()) << "the way around is one still";
}

TEST(Planner, TellsOfWhatMayBeShorterToThoseThatWish) {
  Planned here;
  here.overlay.move(here.thing, box(40, 40, 60, 60));
  here.space.follow();
  const PathId patient = here.planner.keep({.from = {10, 50}, .to = {90, 50}});
  const PathId eager = here.planner.keep({.from = {10, 50}, .to = {90, 50}}, Wish::shortest);
  (void)here.planner.path(patient);
  (void)here.planner.path(eager);
  (void)here.planner.after_edit();
  here.overlay.move(here.thing, box(80, 80, 90, 90));
  here.space.follow();
  EXPECT_THAT(named(here.planner.after_edit()), ElementsAre(eager));
  EXPECT_EQ(here.planner.path(eager).length, 80);
}

TEST(Planner, SeesWhatSwallowsAPathWhole) {
  Planned here;
  const PathId path = here.planner.keep({.from = {40, 40}, .to = {45, 45}});
  const PathId still = here.planner.keep({.from = {42, 42}, .to = {42, 42}});
  EXPECT_EQ(here.planner.path(path).status, Status::found);
  EXPECT_EQ(here.planner.path(still).length, 0);
  (void)here.planner.after_edit();
  here.overlay.move(here.thing, box(30, 30, 60, 60));
  here.space.follow();
  EXPECT_THAT(named(here.planner.after_edit()), ElementsAre(path, still));
  EXPECT_EQ(here.planner.path(path).status, Status::start_blocked);
}

TEST(Planner, WhatHadNoWayHasOneWhenThereIsOne) {
  Planned here;
  const PathId path = here.planner.keep({.from = {10, 50}, .to = {90, 50}});
  const std::vector<Point> wall{{50, 0}, {50, 100}};
  const auto ring = here.overlay.insert(here.walls, wall, overlay::open);
  here.space.follow();
  EXPECT_EQ(here.planner.path(path).status, Status::unreachable);
  here.overlay.remove(ring);
  here.space.follow();
  EXPECT_EQ(here.planner.path(path).length, 80);
}

TEST(Planner, NamesWhatIsBrokenAndNothingElse) {
  int broken_count = 0;
  for (unsigned seed = 0; seed < 8; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const auto number = [&](double low, double high) {
      return std::uniform_real_distribution<>(low, high)(random);
    };
    Planned here;
    std::vector<overlay::RingId> things;
    for (int i = 0; i < 40; ++i) {
      const Point at{number(0, 100), number(0, 100)};
      things.push_back(
          i % 4 == 0 ? here.overlay.insert(
                           here.walls,
                           std::vector<Point>{at, {at.x + number(-9, 9), at.y + number(-9, 9)}},
                           overlay::open)
                     : here.overlay.insert(
                           here.boxes, box(at.x, at.y, at.x + number(1, 6), at.y + number(1, 6))));
    }
    here.space.follow();
    std::vector<PathId> kept;
    for (int i = 0; i < 60; ++i)
      kept.push_back(here.planner.keep(
          {.from = {number(0, 100), number(0, 100)}, .to = {number(0, 100), number(0, 100)}}));
    (void)here.planner.after_edit();
    for (int edit = 0; edit < 60; ++edit) {
      for (const PathId path : kept) (void)here.planner.path(path);
      std::vector<Path> before;
      for (const PathId path : kept) before.push_back(here.planner.path(path));
      here.overlay.begin_batch();
      for (int k = 0; k < 1 + edit % 3; ++k)
        here.overlay.translate(things[random() % things.size()],
                               {number(-15, 15), number(-15, 15)});
      here.overlay.end_batch();
      here.space.follow();
      std::vector<PathId> expected;
      for (std::size_t i = 0; i < kept.size(); ++i) {
        if (before[i].status != Status::found) continue;
        const bool is_way = std::ranges::all_of(before[i].pieces, [&](const Piece& piece) {
          return sees(here.space, piece.from, piece.to);
        });
        if (!is_way || !here.space.is_free(here.planner.query(kept[i]).from))
          expected.push_back(kept[i]);
      }
      broken_count += static_cast<int>(expected.size());
      EXPECT_EQ(named(here.planner.after_edit()), expected);
      for (const PathId path : kept) {
        const Path& found = here.planner.path(path);
        if (std::ranges::find(expected, path) != expected.end()) {
          EXPECT_EQ(found, shortest_path(here.space, here.planner.query(path)));
        }
      }
    }
  }
  EXPECT_GT(broken_count, 300);
}

TEST(Planner, DiscsAreToldOfWhatComesNear) {
  Planned here;
  here.space.keep_gaps();
  const PathId path = here.planner.keep({.from = {10, 50}, .to = {90, 50}, .radius = 5});
  EXPECT_EQ(here.planner.path(path).length, 80);
  (void)here.planner.after_edit();
  here.overlay.move(here.thing, box(40, 55.5, 60, 60));
  here.space.follow();
  EXPECT_THAT(named(here.planner.after_edit()), IsEmpty());
  here.overlay.move(here.thing, box(40, 54.5, 60, 60));
  here.space.follow();
  EXPECT_THAT(named(here.planner.after_edit()), ElementsAre(path));
  EXPECT_GT(here.planner.path(path).length, 80);
}

TEST(Planner, PathsComeAndGo) {
  Planned here;
  const PathId path = here.planner.keep({.from = {10, 50}, .to = {90, 50}});
  (void)here.planner.path(path);
  here.planner.change(path, {.from = {20, 50}, .to = {90, 50}});
  EXPECT_EQ(here.planner.path(path).length, 70);
  here.planner.forget(path);
  EXPECT_FALSE(here.planner.is_kept(path));
  here.overlay.move(here.thing, box(40, 40, 60, 60));
  here.space.follow();
  EXPECT_THAT(named(here.planner.after_edit()), IsEmpty());
  EXPECT_EQ(here.planner.keep({.from = {1, 1}, .to = {2, 1}}), path) << "ids are used again";
}

TEST(CellGrid, KnowsWhatIsFarOutside) {
  CellGrid grid;
  cdt::Box box;
  box.add({0, 0});
  box.add({1, 1});
  grid.lay_out(box, 100);
  const CellGrid::Item far{.owner = 1, .part = 2};
  grid.add(far, {0.5, 0.5}, {5e73, 5e73}, 0);
  for (const Point low : {Point{0.45, 0.45}, Point{4e73, 4e73}}) {
    cdt::Box around;
    around.add(low);
    around.add({low.x * 1.2, low.y * 1.2});
    std::vector<CellGrid::Item> found;
    grid.find(around, found);
    EXPECT_NE(std::find(found.begin(), found.end(), far), found.end()) << low;
  }
}

}  // namespace
}  // namespace loft::paths
