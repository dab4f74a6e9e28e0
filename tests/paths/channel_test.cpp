// SPDX-License-Identifier: MIT
#include "paths/channel.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <vector>

#include "paths/funnel.h"
#include "paths/shortest.h"
#include "tests/cases.h"
#include "tests/cdt/allocations.h"
#include "tests/paths/truth.h"

namespace loft::paths {
namespace {

using overlay::box;

/// Whether one gets straight from a point of portal `from` to one of portal `to`.
bool leads_straight(std::span<const Portal> portals, std::size_t from, Point a, std::size_t to,
                    Point b) {
  for (std::size_t i = from + 1; i < to; ++i) {
    const auto [left, right] = portals[i];
    if (cdt::orient(a, b, left) < 0 || cdt::orient(a, b, right) > 0) return false;
    if (cdt::orient(right, left, a) < 0 || cdt::orient(right, left, b) > 0) return false;
  }
  return true;
}

/// How long the shortest path in a channel is: straight from ends of portals to ends of others.
double shortest_in(const Channel& channel) {
  std::vector<Portal> portals{{channel.from, channel.from}};
  portals.insert(portals.end(), channel.portals.begin(), channel.portals.end());
  portals.push_back({channel.to, channel.to});
  const auto ends = [&](std::size_t i) { return std::array{portals[i].left, portals[i].right}; };
  std::vector<std::array<double, 2>> lengths(portals.size(), {0, 0});
  for (std::size_t to = 1; to < portals.size(); ++to)
    for (std::size_t side = 0; side < 2; ++side) {
      double& length = lengths[to][side];
      length = std::numeric_limits<double>::infinity();
      for (std::size_t from = 0; from < to; ++from)
        for (std::size_t other = 0; other < 2; ++other) {
          const Point a = ends(from)[other];
          const Point b = ends(to)[side];
          if (leads_straight(portals, from, a, to, b))
            length = std::min(length, lengths[from][other] + distance_between(a, b));
        }
    }
  return lengths.back()[0];
}

/// Free triangles, each once, each beside the one before, over the portal between.
void expect_channel(const FreeSpace& space, const Channel& channel) {
  const Triangulation& mesh = space.mesh();
  ASSERT_EQ(channel.triangles.size(), channel.portals.size() + 1);
  std::set<TriangleId> seen;
  for (std::size_t i = 0; i < channel.triangles.size(); ++i) {
    const TriangleId t = channel.triangles[i];
    ASSERT_TRUE(space.is_free(t));
    ASSERT_TRUE(seen.insert(t).second) << "once";
    if (i == 0) continue;
    bool is_beside = false;
    for (unsigned corner = 0; corner < 3; ++corner) {
      const EdgeId e = Triangulation::edge(t, corner);
      is_beside = is_beside || (!space.beyond(e).is_none() &&
                                Triangulation::triangle(mesh.twin(e)) == channel.triangles[i - 1] &&
                                mesh.point(mesh.from(e)) == channel.portals[i - 1].left &&
                                mesh.point(mesh.to(e)) == channel.portals[i - 1].right);
    }
    ASSERT_TRUE(is_beside);
  }
  std::vector<TriangleId> at;
  space.triangles_at(channel.from, at);
  EXPECT_NE(std::ranges::find(at, channel.triangles.front()), at.end());
  space.triangles_at(channel.to, at);
  EXPECT_NE(std::ranges::find(at, channel.triangles.back()), at.end());
}

TEST(Channels, PathsPulledTautAreTheShortestInThemAndSeldomLongerThanTheShortestOfAll) {
  std::size_t count = 0;
  std::size_t longer = 0;
  for (std::uint64_t seed = 0; seed < cases(60); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    SceneMaker maker(seed, all_grounds[seed % all_grounds.size()]);
    const std::size_t obstacles = 20 + maker.index(80);
    const Scene scene = maker.scene(obstacles, maker.index(2) * maker.index(obstacles / 2));
    const Setting setting(scene);
    const Truth truth(setting);
    ChannelSearch search;
    Channel channel;
    for (int i = 0; i < 40; ++i) {
      const Query query = maker.query(scene, truth.corners());
      SCOPED_TRACE(name_of(query));
      search.find(setting.space(), query.from, query.to, channel);
      const Path shortest = shortest_path(setting.space(), query);
      const Path path = pull_taut(channel);
      ASSERT_EQ(channel.status, shortest.status);
      ASSERT_EQ(path.status, shortest.status);
      if (path.status != Status::found) continue;
      ASSERT_NO_FATAL_FAILURE(expect_channel(setting.space(), channel));
      const double length = shortest_in(channel);
      EXPECT_NEAR(path.length, length, tolerance * length);
      EXPECT_GE(path.length, shortest.length * (1 - tolerance));
      ASSERT_NO_FATAL_FAILURE(expect_taut(truth, query, path));
      ++count;
      longer += path.length > 1.001 * shortest.length ? 1 : 0;
    }
  }
  EXPECT_GT(count, cases(600));
  EXPECT_LE(100 * longer, count) << longer << " of " << count;
}

/// A comb: teeth from above and below leave one way only.
TEST(Channels, WhereOnlyOneWayLeadsThePathIsTheShortest) {
  for (std::uint64_t seed = 0; seed < cases(100); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    SceneMaker maker(seed, all_grounds[seed % all_grounds.size()]);
    Scene scene;
    for (double x = 4; x < 90; x += 2 + maker.number(0, 6)) {
      const double tip = maker.number(5, 90);
      const double width = maker.number(0.5, 1.9);
      scene.obstacles.push_back(maker.index(2) == 0
                                    ? Ring{{x, -1}, {x + width, -1}, {x + width / 2, tip}}
                                    : Ring{{x, 97}, {x + width / 2, tip}, {x + width, 97}});
    }
    const Setting setting(scene);
    for (int i = 0; i < 20; ++i) {
      const Query query = maker.query(scene);
      const Path shortest = shortest_path(setting.space(), query);
      const Path path = pull_taut(find_channel(setting.space(), query.from, query.to));
      ASSERT_EQ(path.status, shortest.status);
      ASSERT_EQ(path.pieces, shortest.pieces) << name_of(query);
    }
  }
}

TEST(Channels, StartAndGoalInOneTriangleNeedNoPortal) {
  Scene scene;
  const Setting setting(scene);
  const Channel channel = find_channel(setting.space(), {10, 5}, {20, 6});
  ASSERT_EQ(channel.status, Status::found);
  EXPECT_EQ(channel.triangles.size(), 1U);
  EXPECT_TRUE(channel.portals.empty());
  EXPECT_EQ(pull_taut(channel).pieces, (std::vector<Piece>{{.from = {10, 5}, .to = {20, 6}}}));
  const Path nowhere = pull_taut(find_channel(setting.space(), {10, 5}, {10, 5}));
  EXPECT_EQ(nowhere.status, Status::found);
  EXPECT_EQ(nowhere.length, 0);
  EXPECT_TRUE(nowhere.pieces.empty());
}

TEST(Channels, StatusesAreThoseOfShortestPaths) {
  Scene scene;
  scene.obstacles = {box(40, 40, 60, 60)};
  scene.walls = {{{20, 0}, {20, 96}}};
  const Setting setting(scene);
  const auto status = [&](Point from, Point to) {
    const Channel channel = find_channel(setting.space(), from, to);
    EXPECT_EQ(channel.triangles.empty(), channel.status != Status::found);
    return channel.status;
  };
  EXPECT_EQ(status({50, 50}, {30, 30}), Status::start_blocked);
  EXPECT_EQ(status({30, 30}, {50, 50}), Status::goal_blocked);
  EXPECT_EQ(status({30, 30}, {std::nan(""), 50}), Status::goal_blocked);
  EXPECT_EQ(status({10, 30}, {30, 30}), Status::unreachable);
  EXPECT_EQ(status({20, 30}, {30, 30}), Status::found);
  EXPECT_EQ(status({20, 30}, {10, 30}), Status::found);
}

TEST(Channels, WarmSearchesTakeNoMemory) {
  SceneMaker maker(7, Ground::decimals);
  const Scene scene = maker.scene(60, 10);
  const Setting setting(scene);
  std::vector<Query> queries;
  for (int i = 0; i < 50; ++i) queries.push_back(maker.query(scene));
  Workspace workspace;
  ChannelSearch search;
  Funnel funnel;
  Channel channel;
  Path path;
  const auto find_all = [&] {
    for (const Query& query : queries) {
      workspace.find(setting.space(), query, path);
      search.find(setting.space(), query.from, query.to, channel);
      funnel.pull(channel, path);
    }
  };
  for (int round = 0; round < 20; ++round) find_all();
  const std::size_t before = cdt::allocation_count();
  find_all();
  EXPECT_EQ(cdt::allocation_count(), before);
}

}  // namespace
}  // namespace loft::paths
