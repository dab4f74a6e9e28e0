// SPDX-License-Identifier: MIT
// Shortest paths against a graph of what sees what, with exact decisions.
#include "tests/paths/truth.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "paths/channel.h"
#include "paths/shortest.h"
#include "tests/cases.h"

namespace loft::paths {
namespace {

std::size_t soak_or(const char* variable, std::uint64_t otherwise) {
  const char* asked = std::getenv(variable);
  return asked != nullptr ? std::strtoull(asked, nullptr, 10) : cases(otherwise);
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

/// So often that the workspace knows where dead ends are.
void expect_as_in_new_workspaces(const Setting& setting, std::span<const Query> queries,
                                 Workspace& workspace) {
  Path path;
  for (int round = 0; round < 8; ++round)
    for (const Query& query : queries) {
      workspace.find(setting.space(), query, path);
      ASSERT_EQ(path, shortest_path(setting.space(), query)) << name_of(query);
    }
}

/// With a random one of the obstacles less, no path is longer. Not from crossings: rounded, these
/// may be on the other side of what is left there.
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
    ASSERT_EQ(without.status, Status::found) << name_of(query);
    EXPECT_LE(without.length, with.length * (1 + tolerance)) << name_of(query);
  }
}

void expect_right_in_scene(std::uint64_t seed) {
  SCOPED_TRACE("seed " + std::to_string(seed));
  SceneMaker maker(seed, all_grounds[seed % all_grounds.size()]);
  const std::size_t obstacles = 20 + maker.index(81);
  const Scene scene = maker.scene(obstacles, maker.index(2) * maker.index(obstacles / 2));
  const Setting setting(scene);
  Truth truth(setting);
  Workspace workspace;
  std::vector<Query> queries;
  for (int i = 0; i < 20; ++i) {
    queries.push_back(maker.query(scene, truth.corners()));
    SCOPED_TRACE(name_of(queries.back()));
    ASSERT_NO_FATAL_FAILURE(expect_right(setting, truth, queries.back(), workspace));
  }
  ASSERT_NO_FATAL_FAILURE(expect_as_in_new_workspaces(setting, queries, workspace));
  ASSERT_NO_FATAL_FAILURE(expect_no_longer_without(scene, maker, setting));
}

/// LOFT_SOAK_SCENES for the long run, of 1,000.
TEST(PathsSoak, ShortestPathsAreThoseOfTheVisibilityGraph) {
  const std::size_t scenes = soak_or("LOFT_SOAK_SCENES", 60);
  for (std::uint64_t seed = 0; seed < scenes; ++seed)
    ASSERT_NO_FATAL_FAILURE(expect_right_in_scene(seed));
}

/// Moves obstacles and walls about, one at a time, and compares with what a fresh build finds, each
/// time after so many moves.
void expect_paths_as_fresh(std::uint64_t seed, std::size_t moves, std::size_t every) {
  SCOPED_TRACE("seed " + std::to_string(seed));
  SceneMaker maker(seed, all_grounds[seed % all_grounds.size()]);
  Scene scene = maker.scene(20 + maker.index(30), maker.index(12));
  Setting setting(scene);
  Workspace workspace;
  Path path;
  ChannelSearch search;
  Channel channel;
  for (std::size_t move = 0; move < moves; ++move) {
    const std::size_t shape = maker.index(scene.obstacles.size() + scene.walls.size());
    const bool is_obstacle = shape < scene.obstacles.size();
    Ring& ring = is_obstacle ? scene.obstacles[shape] : scene.walls[shape - scene.obstacles.size()];
    ring = is_obstacle ? maker.obstacle(scene) : maker.wall(scene);
    setting.move(shape, ring);
    if ((move + 1) % every != 0) continue;
    const Setting fresh(scene);
    if (!setting.space().mesh().snaps().empty() || !fresh.space().mesh().snaps().empty()) continue;
    // So many now and then that the workspace learns where dead ends are.
    const int queries = (move + 1) / every % 20 == 0 ? 100 : 4;
    for (int i = 0; i < queries; ++i) {
      const Query query = maker.query(scene);
      workspace.find(setting.space(), query, path);
      ASSERT_EQ(path, shortest_path(fresh.space(), query)) << move << ' ' << name_of(query);
      search.find(setting.space(), query.from, query.to, channel);
      const Channel expected = find_channel(fresh.space(), query.from, query.to);
      ASSERT_EQ(channel.status, expected.status);
      ASSERT_EQ(channel.portals, expected.portals) << move << ' ' << name_of(query);
    }
  }
}

/// LOFT_SOAK_MOVES for the long run, of 10,000.
TEST(PathsSoak, PathsAfterMovesAreThoseOfAFreshBuild) {
  const std::size_t moves = soak_or("LOFT_SOAK_MOVES", 300);
  constexpr std::size_t runs = 2 * all_grounds.size();
  for (std::uint64_t seed = 0; seed < runs; ++seed)
    ASSERT_NO_FATAL_FAILURE(expect_paths_as_fresh(seed, moves / runs, 1));
}

/// LOFT_SOAK_MANY_MOVES for the long run, of 1,000,000, compared every hundred.
TEST(PathsSoak, PathsAfterManyMovesAreThoseOfAFreshBuild) {
  const std::size_t moves = soak_or("LOFT_SOAK_MANY_MOVES", 20'000);
  constexpr std::size_t runs = 2 * all_grounds.size();
  for (std::uint64_t seed = 0; seed < runs; ++seed)
    ASSERT_NO_FATAL_FAILURE(expect_paths_as_fresh(100 + seed, moves / runs, 100));
}

}  // namespace
}  // namespace loft::paths
