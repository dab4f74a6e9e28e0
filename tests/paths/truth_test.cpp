// SPDX-License-Identifier: MIT
// Shortest paths against a graph of what sees what, with exact decisions.
#include "tests/paths/truth.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>
#include <sstream>
#include <string>

#include "paths/shortest.h"
#include "tests/cases.h"

namespace loft::paths {
namespace {

constexpr double tolerance = 1e-12;

std::size_t soak_or(const char* variable, std::uint64_t otherwise) {
  const char* asked = std::getenv(variable);
  return asked != nullptr ? std::strtoull(asked, nullptr, 10) : cases(otherwise);
}

Ground ground_of(std::uint64_t seed) { return all_grounds[seed % all_grounds.size()]; }

/// Some from anywhere, some from corners and edges of what is in the scene.
Query random_query(SceneMaker& maker, const Scene& scene, std::span<const Point> corners) {
  const auto end = [&] {
    const std::size_t kind = maker.index(6);
    if (kind == 0) return maker.place_on(scene);
    if (kind == 1 && !corners.empty()) return corners[maker.index(corners.size())];
    return maker.place();
  };
  const Point from = end();
  return {.from = from, .to = end()};
}

/// A path is what it says: from start to goal, clear of everything, with turns only where it must.
void expect_taut(const Truth& truth, const Query& query, const Path& path) {
  Point at = query.from;
  double length = 0;
  for (const Piece& piece : path.pieces) {
    ASSERT_EQ(piece.from, at);
    ASSERT_NE(piece.from, piece.to);
    ASSERT_EQ(piece.turn, Turn::straight);
    at = piece.to;
    length += length_between(piece.from, piece.to);
  }
  ASSERT_EQ(at, query.to);
  EXPECT_NEAR(length, path.length, tolerance * length);
  EXPECT_TRUE(truth.is_clear(path.pieces));
  for (std::size_t i = 0; i + 1 < path.pieces.size(); ++i)
    EXPECT_TRUE(truth.turns_around_something(path.pieces[i].from, path.pieces[i].to,
                                             path.pieces[i + 1].to))
        << path.pieces[i].to;
}

/// The right path, and as long the other way round.
void expect_right(const Setting& setting, Truth& truth, const Query& query, Workspace& workspace) {
  Path path;
  workspace.find(setting.space(), query, path);
  const bool is_start_free = truth.is_free(query.from);
  if (!is_start_free || !truth.is_free(query.to)) {
    EXPECT_EQ(path.status, is_start_free ? Status::goal_blocked : Status::start_blocked);
    return;
  }
  const auto length = truth.length(query.from, query.to);
  ASSERT_EQ(path.status, length ? Status::found : Status::unreachable);
  EXPECT_EQ(setting.space().is_reachable(query.from, query.to), length.has_value());
  Path back;
  workspace.find(setting.space(), {.from = query.to, .to = query.from}, back);
  ASSERT_EQ(back.status, path.status);
  if (!length) return;
  EXPECT_NEAR(path.length, *length, tolerance * *length);
  EXPECT_NEAR(back.length, path.length, tolerance * *length);
  ASSERT_NO_FATAL_FAILURE(expect_taut(truth, query, path));
}

/// With a random one of the obstacles less, no path is longer. Not from crossings: rounded, these may
/// be on the other side of what is left there.
void expect_no_longer_without(const Scene& scene, SceneMaker& maker, const Setting& setting) {
  Scene less = scene;
  const std::size_t taken = maker.index(less.obstacles.size());
  less.obstacles.erase(less.obstacles.begin() + static_cast<std::ptrdiff_t>(taken));
  const Setting cleared(less);
  for (int i = 0; i < 20; ++i) {
    const Query query{.from = maker.place(), .to = maker.place()};
    const Path with = shortest_path(setting.space(), query);
    if (with.status != Status::found) continue;
    const Path without = shortest_path(cleared.space(), query);
    ASSERT_EQ(without.status, Status::found) << query.from << query.to;
    EXPECT_LE(without.length, with.length * (1 + tolerance)) << query.from << query.to;
  }
}

void expect_right_in_scene(std::uint64_t seed) {
  SCOPED_TRACE("seed " + std::to_string(seed));
  SceneMaker maker(seed, ground_of(seed));
  const std::size_t obstacles = 20 + maker.index(81);
  const Scene scene = maker.scene(obstacles, maker.index(2) * maker.index(obstacles / 2));
  const Setting setting(scene);
  Truth truth(setting);
  Workspace workspace;
  for (int i = 0; i < 20; ++i) {
    const Query query = random_query(maker, scene, truth.corners());
    std::ostringstream name;
    name << query.from << " to " << query.to;
    SCOPED_TRACE(name.str());
    ASSERT_NO_FATAL_FAILURE(expect_right(setting, truth, query, workspace));
  }
  ASSERT_NO_FATAL_FAILURE(expect_no_longer_without(scene, maker, setting));
}

/// LOFT_SOAK_SCENES for the long run, of 1,000.
TEST(PathsSoak, ShortestPathsAreThoseOfTheVisibilityGraph) {
  const std::size_t scenes = soak_or("LOFT_SOAK_SCENES", 60);
  for (std::uint64_t seed = 0; seed < scenes; ++seed)
    ASSERT_NO_FATAL_FAILURE(expect_right_in_scene(seed));
}

/// Moves obstacles and walls about, one at a time, and compares with what a fresh build finds.
void expect_paths_as_fresh(std::uint64_t seed, std::size_t moves) {
  SCOPED_TRACE("seed " + std::to_string(seed));
  SceneMaker maker(seed, ground_of(seed));
  Scene scene = maker.scene(20 + maker.index(30), maker.index(12));
  Setting setting(scene);
  Workspace workspace;
  Path path;
  for (std::size_t move = 0; move < moves; ++move) {
    const std::size_t shape = maker.index(scene.obstacles.size() + scene.walls.size());
    const bool is_obstacle = shape < scene.obstacles.size();
    Ring& ring = is_obstacle ? scene.obstacles[shape] : scene.walls[shape - scene.obstacles.size()];
    ring = is_obstacle ? maker.obstacle(scene) : maker.wall(scene);
    setting.move(shape, ring);
    const Setting fresh(scene);
    if (!setting.space().mesh().snaps().empty() || !fresh.space().mesh().snaps().empty()) continue;
    // So many now and then that the workspace learns where dead ends are.
    const int queries = move % 20 == 19 ? 100 : 4;
    for (int i = 0; i < queries; ++i) {
      const Query query = random_query(maker, scene, {});
      workspace.find(setting.space(), query, path);
      ASSERT_EQ(path, shortest_path(fresh.space(), query)) << move << query.from << query.to;
    }
  }
}

/// LOFT_SOAK_MOVES for the long run, of 10,000.
TEST(PathsSoak, PathsAfterMovesAreThoseOfAFreshBuild) {
  const std::size_t moves = soak_or("LOFT_SOAK_MOVES", 300);
  constexpr std::size_t runs = 2 * all_grounds.size();
  for (std::uint64_t seed = 0; seed < runs; ++seed)
    ASSERT_NO_FATAL_FAILURE(expect_paths_as_fresh(seed, moves / runs));
}

}  // namespace
}  // namespace loft::paths
